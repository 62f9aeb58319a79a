//! Which device is found, and what is said when none is.

use afterglow_gpu::doctor::examine;
use afterglow_gpu::{Gpu, GpuError, GpuOptions};

use crate::support::CheckedGpu;

#[test]
fn tests_run_on_a_recent_device() {
    let gpu = CheckedGpu::new();
    let info = gpu.info();
    assert!(info.refused.is_empty());
    assert_eq!(info.features, *gpu.features());
    assert!(gpu.limits().max_push_constants_size >= 128);
}

#[test]
fn without_a_loader_the_error_says_so() {
    let options = GpuOptions { loader: Some("/nonexistent/libvulkan.so.1".into()), ..GpuOptions::default() };
    let error = Gpu::new(&options).err().unwrap();
    assert!(matches!(error, GpuError::NoVulkan(_)), "{error}");
    assert!(error.is_no_device());
    let report = examine(&options);
    assert_eq!(report.loader_version, None);
    assert!(report.error.is_some() && report.chosen.is_none());
}

#[test]
fn an_unknown_device_is_refused_with_reasons() {
    let options = GpuOptions { device: Some("Voodoo 2".to_owned()), ..GpuOptions::default() };
    let Err(GpuError::NoDevice(refusals)) = Gpu::new(&options) else {
        panic!("there is no such device");
    };
    for refusal in refusals {
        assert!(refusal.reasons.contains(&"not called Voodoo 2".to_owned()));
    }
}

#[test]
fn the_doctor_chooses_what_is_opened() {
    let options = GpuOptions { validation: false, ..GpuOptions::for_tests() };
    let report = examine(&options);
    let chosen = report.chosen.as_ref().unwrap();
    let gpu = Gpu::new(&options).unwrap();
    assert_eq!(chosen.device, gpu.info().name);
    assert!(report.devices.iter().any(|device| device.info.refused.is_empty()));
    let json = serde_json::to_value(&report).unwrap();
    assert!(json["devices"][0]["name"].is_string());
    assert!(json["chosen"]["why"].is_string());
}
