//! Resources dropped at bad times, recordings begun at bad times.

use afterglow_gpu::{BufferDesc, BufferKind, GpuError};

use crate::support::CheckedGpu;

#[test]
fn a_buffer_dropped_while_recorded_lives_until_the_device_has_finished() {
    let gpu = CheckedGpu::new();
    let target = gpu.create_buffer(&BufferDesc::new("target", BufferKind::Device, 64)).unwrap();
    let recording = gpu.record().unwrap();
    let source = gpu.create_buffer(&BufferDesc::new("source", BufferKind::Device, 64)).unwrap();
    recording.fill_buffer(&source, 1);
    drop(source);
    assert_eq!(gpu.garbage_count(), 1);
    gpu.collect().unwrap();
    assert_eq!(gpu.garbage_count(), 1, "it is still being recorded");
    recording.fill_buffer(&target, 2);
    let submission = recording.submit().unwrap();
    gpu.wait(submission).unwrap();
    assert!(gpu.is_finished(submission).unwrap());
    assert_eq!(gpu.garbage_count(), 0);
}

#[test]
fn an_abandoned_recording_leaves_no_trace() {
    let gpu = CheckedGpu::new();
    let buffer = gpu.create_buffer(&BufferDesc::new("buffer", BufferKind::Device, 64)).unwrap();
    for _ in 0..10 {
        gpu.record().unwrap().fill_buffer(&buffer, 1);
    }
    gpu.run(|commands| commands.fill_buffer(&buffer, 7)).unwrap();
    assert_eq!(gpu.download_buffer(&buffer).unwrap()[0], 7);
}

#[test]
fn a_recording_inside_another_is_an_error() {
    let gpu = CheckedGpu::new();
    let outer = gpu.record().unwrap();
    assert!(matches!(gpu.record(), Err(GpuError::NestedRecording)));
    drop(outer);
    assert!(gpu.record().is_ok());
}

#[test]
fn threads_take_turns() {
    let gpu = CheckedGpu::new();
    std::thread::scope(|scope| {
        for word in 1..=3_u8 {
            let gpu = &gpu;
            scope.spawn(move || {
                for _ in 0..20 {
                    let desc = BufferDesc::new("turn", BufferKind::Device, 4);
                    let buffer = gpu.create_buffer(&desc).unwrap();
                    gpu.submit(|commands| commands.fill_buffer(&buffer, word.into())).unwrap();
                    assert_eq!(gpu.download_buffer(&buffer).unwrap()[0], word);
                }
            });
        }
    });
    gpu.wait_idle().unwrap();
}

#[test]
fn memory_is_given_back() {
    let gpu = CheckedGpu::new();
    let before = gpu.memory_use().used;
    for _ in 0..100 {
        let desc = BufferDesc::new("large", BufferKind::Device, 1 << 20);
        let buffer = gpu.create_buffer(&desc).unwrap();
        gpu.submit(|commands| commands.fill_buffer(&buffer, 0)).unwrap();
    }
    gpu.wait_idle().unwrap();
    assert_eq!(gpu.memory_use().used, before);
    assert!(gpu.memory_use().reserved < 1 << 30);
}

#[test]
fn a_device_outlives_its_last_handle_by_its_resources() {
    let gpu = CheckedGpu::new().0.clone();
    let desc = BufferDesc::new("orphan", BufferKind::Upload, 16);
    let mut buffer = gpu.create_buffer(&desc).unwrap();
    drop(gpu);
    buffer.write(0, &[1; 16]).unwrap();
}
