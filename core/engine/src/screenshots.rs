//! Pictures that are written to files while a program plays.

use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::thread::JoinHandle;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use afterglow_images::write_png;

/// Pictures that are being written, at most.
const MOST_WAITING: usize = 4;
/// Pictures of the same name, at most.
const MOST_ALIKE: u32 = 100;
const DAY: u64 = 86_400;

/// A picture to be written.
pub(crate) struct Picture {
    /// Width and height, pixels.
    pub(crate) size: [u32; 2],
    /// Four bytes a pixel, the highest row first.
    pub(crate) rgba: Vec<u8>,
    /// Of those shown in its window, counted from 1.
    pub(crate) frame: u64,
}

/// Pictures that are being written, each by a thread.
pub(crate) struct Screenshots {
    threads: Vec<JoinHandle<()>>,
    sender: mpsc::Sender<String>,
    /// What became of them.
    said: mpsc::Receiver<String>,
}

impl Default for Screenshots {
    fn default() -> Self {
        let (sender, said) = mpsc::channel();
        Self { threads: Vec::new(), sender, said }
    }
}

impl Screenshots {
    /// Has a picture written into a folder, which is made if it is not there. What becomes of it is said later, or now
    /// if nothing does.
    pub(crate) fn write(&mut self, folder: &Path, picture: Picture) -> Option<String> {
        self.threads.retain(|thread| !thread.is_finished());
        if self.threads.len() >= MOST_WAITING {
            return Some("no screenshot: others are being written".into());
        }
        let (folder, sender) = (folder.to_owned(), self.sender.clone());
        let program = std::env::current_exe().ok();
        let name = name(program.as_deref(), SystemTime::now(), picture.frame);
        let spawned = std::thread::Builder::new().name("afterglow-shot".into()).spawn(move || {
            let said = match write(&folder, &name, picture) {
                Ok(path) => {
                    tracing::info!("screenshot: {}", path.display());
                    format!("screenshot: {}", path.display())
                }
                Err(error) => {
                    tracing::error!("no screenshot in {}: {error}", folder.display());
                    format!("no screenshot: {error}")
                }
            };
            let _ = sender.send(said);
        });
        match spawned {
            Ok(thread) => {
                self.threads.push(thread);
                None
            }
            Err(error) => Some(format!("no screenshot: {error}")),
        }
    }

    /// What became of a picture since it was asked last.
    pub(crate) fn said(&self) -> Option<String> {
        self.said.try_iter().last()
    }
}

/// What was asked for is there when the program has ended.
impl Drop for Screenshots {
    fn drop(&mut self) {
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
    }
}

/// Writes a picture under a name that no file has.
fn write(folder: &Path, name: &str, mut picture: Picture) -> Result<PathBuf, String> {
    std::fs::create_dir_all(folder).map_err(|error| error.to_string())?;
    // A window has no alpha.
    picture.rgba.as_chunks_mut::<4>().0.iter_mut().for_each(|pixel| pixel[3] = 255);
    let names = (1..=MOST_ALIKE).map(|number| match number {
        1 => folder.join(format!("{name}.png")),
        number => folder.join(format!("{name}-{number}.png")),
    });
    // `exists` also counts what cannot be looked at as absent; then writing says why.
    let path = names.into_iter().find(|path| !path.exists()).ok_or("there are too many of them")?;
    write_png(&path, picture.size, &picture.rgba).map_err(|error| error.to_string())?;
    Ok(path)
}

/// Program, time (UTC) and frame.
fn name(program: Option<&Path>, now: SystemTime, frame: u64) -> String {
    let program = program.and_then(Path::file_name).map_or("afterglow".into(), |name| name.to_string_lossy());
    // Clocks before 1970 are wrong anyway.
    let seconds = now.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO).as_secs();
    let (year, month, day) = date(seconds / DAY);
    let (hour, minute, second) = (seconds % DAY / 3600, seconds / 60 % 60, seconds % 60);
    format!("{program}-{year:04}{month:02}{day:02}-{hour:02}{minute:02}{second:02}-frame-{frame:06}")
}

/// Year, month and day of a day counted from 1970-01-01, in the Gregorian calendar.
///
/// Howard Hinnant, "chrono-Compatible Low-Level Date Algorithms", `civil_from_days`.
fn date(day: u64) -> (u64, u64, u64) {
    // Years begin in March, eras with the year 0.
    let day = day + 719_468;
    let (era, day_of_era) = (day / 146_097, day % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month = (5 * day_of_year + 2) / 153;
    let day_of_month = day_of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    (year_of_era + era * 400 + u64::from(month <= 2), month, day_of_month)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(frame: u64) -> Picture {
        Picture { size: [2, 1], rgba: vec![1, 2, 3, 0, 4, 5, 6, 0], frame }
    }

    #[test]
    fn names_tell_program_time_and_frame() {
        let at = UNIX_EPOCH + Duration::from_secs(951_827_696);
        assert_eq!(name(Some("/usr/bin/game".as_ref()), at, 7), "game-20000229-123456-frame-000007");
        assert_eq!(name(None, UNIX_EPOCH, 1_234_567), "afterglow-19700101-000000-frame-1234567");
        assert_eq!([date(59), date(10_957), date(20_785)], [(1970, 3, 1), (2000, 1, 1), (2026, 11, 28)]);
    }

    #[test]
    fn pictures_are_written_and_it_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let below = folder.path().join("a/b");
        let mut shots = Screenshots::default();
        for _ in 0..2 {
            assert_eq!(shots.write(&below, picture(3)), None);
            let said = shots.said.recv_timeout(Duration::from_secs(60)).unwrap();
            let path = said.strip_prefix("screenshot: ").unwrap();
            assert!(path.contains("-frame-000003") && Path::new(path).starts_with(&below), "{said}");
        }
        drop(shots);
        assert_eq!(std::fs::read_dir(&below).unwrap().count(), 2);
    }

    #[test]
    fn a_file_in_place_of_the_folder_is_no_failure() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        std::fs::write(&file, "").unwrap();
        assert!(write(&file, "x", picture(1)).is_err());
        let path = write(folder.path(), "x", picture(1)).unwrap();
        assert_eq!(write(folder.path(), "x", picture(1)).unwrap(), folder.path().join("x-2.png"));
        assert_eq!(path, folder.path().join("x.png"));
    }
}
