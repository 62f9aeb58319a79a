//! `afterglow-gen [--check] [ROOT]`: writes the generated files, or says which are not current.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use afterglow_gen::{differing, outputs, write};

fn main() -> ExitCode {
    let (options, places): (Vec<_>, Vec<_>) =
        std::env::args().skip(1).partition(|argument| argument.starts_with('-'));
    if places.len() > 1 || options.iter().any(|option| option != "--check") {
        eprintln!("usage: afterglow-gen [--check] [ROOT]");
        return ExitCode::from(2);
    }
    let root = PathBuf::from(places.first().map_or(".", String::as_str));
    match generate(root, !options.is_empty()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("afterglow-gen: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Writes what is not current, or only names it; whether all is well then.
fn generate(root: PathBuf, only_check: bool) -> Result<bool, Box<dyn Error>> {
    let outputs = outputs(&root)?;
    let stale = differing(&root, &outputs);
    for output in &stale {
        if only_check {
            eprintln!("{} is not what the generator writes; run ./x gen", output.path);
        } else {
            println!("writing {}", output.path);
            write(&root, output)?;
        }
    }
    Ok(stale.is_empty() || !only_check)
}
