//! The thread that reads files.

use std::fs::File;
use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender};
use std::time::{Duration, Instant};

use hashbrown::{HashMap, HashSet};

use crate::error::ImageError;
use crate::folder::Arrival;
use crate::index::{Index, Stamp};
use crate::name::{FileName, Role};
use crate::picture::Picture;
use crate::read::{Abilities, MOST_FILE_BYTES, decode};

/// How often the folder is looked at.
const PERIOD: Duration = Duration::from_secs(1);

/// What the thread is asked.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Request {
    /// For all that replaces the texture with this hash.
    Ask(u64),
    /// To look after it no more.
    Forget(u64),
}

/// Whoever has asked is gone.
struct Gone;

pub(crate) struct Worker {
    folder: PathBuf,
    abilities: Abilities,
    arrivals: SyncSender<Arrival>,
    index: Index,
    /// Whether the folder could be listed when it was looked at last.
    is_listed: bool,
    /// Textures whose files are looked after.
    wanted: HashSet<u64>,
    /// Files as they were when they were read last, be they pictures or not.
    read: HashMap<FileName, (PathBuf, Option<Stamp>)>,
}

impl Worker {
    pub(crate) fn new(folder: PathBuf, abilities: Abilities, arrivals: SyncSender<Arrival>) -> Self {
        Self {
            folder,
            abilities,
            arrivals,
            index: Index::default(),
            is_listed: true,
            wanted: HashSet::new(),
            read: HashMap::new(),
        }
    }

    /// Answers requests, and looks at the folder in between, until nobody is there to be answered.
    pub(crate) fn run(mut self, requests: &Receiver<Request>) {
        self.list();
        let mut next = Instant::now() + PERIOD;
        loop {
            let handled = match requests.recv_timeout(next.saturating_duration_since(Instant::now())) {
                Ok(Request::Ask(hash)) => self.answer(hash),
                Ok(Request::Forget(hash)) => {
                    self.forget(hash);
                    Ok(())
                }
                Err(RecvTimeoutError::Timeout) => Ok(()),
                Err(RecvTimeoutError::Disconnected) => Err(Gone),
            };
            let looked = match handled {
                Ok(()) if Instant::now() >= next => {
                    let looked = self.look();
                    next = Instant::now() + PERIOD;
                    looked
                }
                handled => handled,
            };
            if looked.is_err() {
                return;
            }
        }
    }

    fn list(&mut self) {
        match Index::of(&self.folder) {
            Ok(index) => {
                self.index = index;
                self.is_listed = true;
            }
            Err(error) => {
                if std::mem::replace(&mut self.is_listed, false) {
                    tracing::warn!("{}: no images are replaced: {error}", self.folder.display());
                }
                self.index = Index::default();
            }
        }
    }

    /// Reads all that replaces a texture.
    fn answer(&mut self, hash: u64) -> Result<(), Gone> {
        self.wanted.insert(hash);
        for role in Role::ALL {
            let name = FileName { hash, role };
            self.read.remove(&name);
            self.update(name)?;
        }
        self.send(Arrival::All { hash })
    }

    fn forget(&mut self, hash: u64) {
        self.wanted.remove(&hash);
        for role in Role::ALL {
            self.read.remove(&FileName { hash, role });
        }
    }

    /// Reads what has changed.
    fn look(&mut self) -> Result<(), Gone> {
        self.list();
        let wanted: Vec<u64> = self.wanted.iter().copied().collect();
        let names = wanted.into_iter().flat_map(|hash| Role::ALL.map(|role| FileName { hash, role }));
        names.into_iter().try_for_each(|name| self.update(name))
    }

    /// Reads a file if it is not as it was, and says so. What is no picture leaves what was there.
    fn update(&mut self, name: FileName) -> Result<(), Gone> {
        let Some(path) = self.index.get(name) else {
            return match self.read.remove(&name) {
                Some(_) => self.send(Arrival::Picture { name, picture: None }),
                None => Ok(()),
            };
        };
        let now = (path.to_owned(), Stamp::of(path));
        if self.read.get(&name) == Some(&now) {
            return Ok(());
        }
        let picture = read(path, name.role, self.abilities);
        self.read.insert(name, now.clone());
        match picture {
            Ok(picture) => self.send(Arrival::Picture { name, picture: Some(picture) }),
            Err(error) => {
                tracing::warn!("{}: {error}", now.0.display());
                Ok(())
            }
        }
    }

    fn send(&self, arrival: Arrival) -> Result<(), Gone> {
        self.arrivals.send(arrival).map_err(|_| Gone)
    }
}

/// A file as a picture.
fn read(path: &Path, role: Role, abilities: Abilities) -> Result<Picture, ImageError> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MOST_FILE_BYTES + 1).read_to_end(&mut bytes)?;
    // Decoders are others' work: should one panic on a file, that file is damaged.
    let decoded = catch_unwind(AssertUnwindSafe(|| decode(&bytes, role, abilities)));
    decoded.unwrap_or_else(|_| Err(ImageError::damaged("it cannot be decoded")))
}
