//! A folder of replacements, read on a thread of its own.

use std::io;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel, sync_channel};
use std::thread;

use crate::name::FileName;
use crate::picture::Picture;
use crate::read::Abilities;
use crate::worker::{Request, Worker};

/// Pictures that wait to be taken; the thread goes on when there are fewer.
const MOST_WAITING: usize = 4;

/// What the thread has to tell.
#[derive(Debug)]
pub enum Arrival {
    /// What is to replace a texture, or that nothing does any more. It may come again when the file has changed.
    Picture { name: FileName, picture: Option<Picture> },
    /// All files of a texture that was asked for have come.
    All { hash: u64 },
}

/// A folder of replacements. The thread ends some time after this is dropped.
#[derive(Debug)]
pub struct Folder {
    requests: Sender<Request>,
    arrivals: Receiver<Arrival>,
}

impl Folder {
    /// Starts to look after a folder, which need not be there yet.
    ///
    /// # Errors
    /// If there can be no more threads.
    pub fn open(path: PathBuf, abilities: Abilities) -> io::Result<Folder> {
        let (requests, asked) = channel();
        let (arrived, arrivals) = sync_channel(MOST_WAITING);
        let worker = Worker::new(path, abilities, arrived);
        thread::Builder::new().name("images".into()).spawn(move || worker.run(&asked))?;
        Ok(Folder { requests, arrivals })
    }

    /// Asks for what replaces the texture with this hash. Later changes of its files arrive unasked.
    pub fn ask(&self, hash: u64) {
        // If the thread has ended, nothing arrives, and that is all there is to say.
        let _ = self.requests.send(Request::Ask(hash));
    }

    /// Looks after a texture's files no more.
    pub fn forget(&self, hash: u64) {
        let _ = self.requests.send(Request::Forget(hash));
    }

    /// What has arrived, if anything has.
    pub fn arrival(&self) -> Option<Arrival> {
        self.arrivals.try_recv().ok()
    }

    /// What arrives next; waits for it. None if nothing ever will.
    pub fn wait(&self) -> Option<Arrival> {
        self.arrivals.recv().ok()
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::time::{Duration, Instant};

    use super::*;
    use crate::name::Role;
    use crate::read::testing::png;

    const HASH: u64 = 0x0123_4567_89ab_cdef;

    fn name(role: Role) -> FileName {
        FileName { hash: HASH, role }
    }

    /// What arrives until all has, by role.
    fn all(folder: &Folder) -> Vec<(Role, Vec<u8>)> {
        let mut found = Vec::new();
        loop {
            match folder.wait().unwrap() {
                Arrival::All { hash } => {
                    assert_eq!(hash, HASH);
                    return found;
                }
                Arrival::Picture { name, picture } => {
                    found.push((name.role, picture.unwrap().levels.remove(0)))
                }
            }
        }
    }

    /// What arrives within a few seconds.
    fn soon(folder: &Folder) -> Option<Picture> {
        let begun = Instant::now();
        loop {
            match folder.arrival() {
                Some(Arrival::Picture { picture, .. }) => return picture,
                Some(Arrival::All { .. }) => {}
                None => thread::sleep(Duration::from_millis(20)),
            }
            assert!(begun.elapsed() < Duration::from_secs(20));
        }
    }

    #[test]
    fn what_is_asked_for_arrives_and_changes_follow() {
        let folder = tempfile::tempdir().unwrap();
        let path = |role| folder.path().join(format!("{}.png", name(role)));
        fs::write(path(Role::Color), png(1, 1, &[[1, 2, 3, 4]])).unwrap();
        fs::write(path(Role::Normal), "no picture").unwrap();
        let images = Folder::open(folder.path().into(), Abilities::default()).unwrap();
        assert!(images.arrival().is_none());
        images.ask(HASH);
        assert_eq!(all(&images), [(Role::Color, vec![1, 2, 3, 4])]);
        images.ask(HASH);
        assert_eq!(all(&images).len(), 1);

        let changed = Instant::now();
        fs::write(path(Role::Color), png(2, 1, &[[5; 4]; 2])).unwrap();
        assert_eq!(soon(&images).unwrap().width, 2);
        assert!(changed.elapsed() < Duration::from_secs(5));
        fs::write(path(Role::Emission), png(1, 1, &[[9; 4]])).unwrap();
        assert_eq!(soon(&images).unwrap().levels[0], [9; 4]);
        // A damaged file leaves what was there; one that is gone leaves nothing.
        fs::write(path(Role::Color), "no picture").unwrap();
        fs::remove_file(path(Role::Emission)).unwrap();
        assert_eq!(soon(&images), None);
    }

    #[test]
    fn a_folder_may_come_later() {
        let parent = tempfile::tempdir().unwrap();
        let path = parent.path().join("images");
        let images = Folder::open(path.clone(), Abilities::default()).unwrap();
        images.ask(HASH);
        assert_eq!(all(&images), []);
        fs::create_dir(&path).unwrap();
        fs::write(path.join(format!("{}.png", name(Role::Color))), png(1, 1, &[[6; 4]])).unwrap();
        assert_eq!(soon(&images).unwrap().levels[0], [6; 4]);
    }
}
