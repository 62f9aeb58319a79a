//! Which profile a program has.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

use xxhash_rust::xxh3::Xxh3;

use super::parse::ProfileError;
use super::rules::{Hash, Profile};

/// Names and texts of the profiles in `manifests/apps`.
const SHIPPED: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/profiles.rs"));

/// The profiles that are part of the library: file name and content.
pub fn shipped() -> &'static [(&'static str, &'static str)] {
    SHIPPED
}

/// Where a profile is to come from.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum ProfileChoice {
    /// One of those that are shipped, if the program's name is in it.
    #[default]
    ByName,
    /// Nowhere.
    None,
    /// A file.
    File(PathBuf),
}

impl FromStr for ProfileChoice {
    type Err = std::convert::Infallible;

    /// As options have it: `none`, or a path.
    fn from_str(text: &str) -> Result<ProfileChoice, Self::Err> {
        Ok(match text {
            "" => ProfileChoice::ByName,
            "none" => ProfileChoice::None,
            path => ProfileChoice::File(path.into()),
        })
    }
}

impl ProfileChoice {
    /// The profile of a program, if there is one.
    ///
    /// # Errors
    /// If it is no profile.
    pub fn load(&self, program: Option<&Path>) -> Result<Option<Arc<Profile>>, ProfileError> {
        match self {
            ProfileChoice::None => Ok(None),
            ProfileChoice::File(path) => Profile::read(path).map(|profile| Some(Arc::new(profile))),
            ProfileChoice::ByName => by_name(SHIPPED, program).map(|profile| profile.map(Arc::new)),
        }
    }
}

/// The first profile that names a program.
fn by_name(profiles: &[(&str, &str)], program: Option<&Path>) -> Result<Option<Profile>, ProfileError> {
    let named = program.and_then(|program| Some((program, program.file_name()?.to_str()?)));
    let Some((program, name)) = named else { return Ok(None) };
    for (file, text) in profiles {
        let profile = Profile::parse(file, text)?;
        let is_meant = profile.executables.iter().any(|executable| executable == name);
        if is_meant && profile.executable_hash.is_none_or(|hash| hash_of(program) == Some(hash)) {
            return Ok(Some(profile));
        }
    }
    Ok(None)
}

/// XXH3 of a file.
fn hash_of(path: &Path) -> Option<Hash> {
    let mut file = BufReader::new(File::open(path).ok()?);
    let (mut hasher, mut bytes) = (Xxh3::new(), vec![0; 1 << 16]);
    loop {
        match file.read(&mut bytes).ok()? {
            0 => return Some(Hash(hasher.digest())),
            count => hasher.update(&bytes[..count]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shipped_profiles_are_sound() {
        for (file, text) in shipped() {
            let profile = Profile::parse(file, text).unwrap();
            assert!(!profile.executables.is_empty(), "{file} is for no program");
        }
    }

    #[test]
    fn programs_are_known_by_name_and_hash() {
        let texts = [
            ("a", "name = 'A'\nexecutables = ['game']\nexecutable_hash = '0000000000000001'"),
            ("b", "name = 'B'\nexecutables = ['game', 'other']"),
        ];
        let find = |path: &str| by_name(&texts, Some(Path::new(path))).unwrap().map(|profile| profile.name);
        assert_eq!(find("/usr/games/game"), Some("B".into()));
        assert_eq!(find("other"), Some("B".into()));
        assert_eq!(find("/usr/games/none"), None);
        assert!(by_name(&texts, None).unwrap().is_none());
        let own = std::env::current_exe().unwrap();
        let hash = hash_of(&own).unwrap().0;
        let name = own.file_name().unwrap().to_str().unwrap();
        let text = format!("name = 'own'\nexecutables = ['{name}']\nexecutable_hash = '{hash:016x}'");
        assert!(by_name(&[("own", &text)], Some(&own)).unwrap().is_some());
    }

    #[test]
    fn images_lie_beside_the_file() {
        let path = std::env::temp_dir().join(format!("afterglow-profile-{}.toml", std::process::id()));
        std::fs::write(&path, "name = 'A'\nimages = 'pack'").unwrap();
        let profile = ProfileChoice::File(path.clone()).load(None);
        std::fs::remove_file(&path).unwrap();
        assert_eq!(profile.unwrap().unwrap().images, Some(std::env::temp_dir().join("pack")));
    }

    #[test]
    fn options_name_a_file_or_none() {
        assert_eq!("none".parse(), Ok(ProfileChoice::None));
        assert_eq!("".parse(), Ok(ProfileChoice::ByName));
        assert_eq!("a.toml".parse(), Ok(ProfileChoice::File("a.toml".into())));
        assert!(ProfileChoice::File("/nowhere/a.toml".into()).load(None).is_err());
    }
}
