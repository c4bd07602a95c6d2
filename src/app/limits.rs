//! Limits of the system and of this program on files: how large they may become, how much of one is read.

use super::Failure;
use frictionsim_bounds::{Budget, Limits, Refusal};
use std::fs::File;
use std::io;
use std::path::Path;

/// Makes a write beyond the file size limit of the shell (`ulimit -f`) an error, as on a full disk, where the signal of
/// it would end the process without a word.
pub fn refuse_writes_beyond_limit() {
    #[cfg(unix)]
    {
        let noticed = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
        // Without the handler such a write ends the process, which is no reason not to begin.
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, noticed);
    }
}

/// The name that stands for standard input.
pub const STANDARD_INPUT: &str = "-";

/// Reads a file, a pipe or standard input within the limits of its kind.
///
/// # Errors
/// [`Failure::Usage`] with the file's name: it cannot be read, or has no end within the limit.
pub fn read_input(path: &Path, limits: Limits) -> Result<Vec<u8>, Failure> {
    let mut budget = Budget::new(limits);
    let read = match path == Path::new(STANDARD_INPUT) {
        true => budget.read_all(io::stdin().lock()),
        false => File::open(path).map_err(Refusal::from).and_then(|file| budget.read_all(file)),
    };
    let name = input_name(path);
    read.map_err(|refusal| match refusal {
        Refusal::Bytes { most, .. } => {
            let most = most >> 20;
            Failure::usage(format!("{name} is larger than {most} MiB, the limit for such files"))
        }
        other => Failure::usage(format!("cannot read {name}: {other}")),
    })
}

/// What an input is called in messages.
pub fn input_name(path: &Path) -> String {
    if path == Path::new(STANDARD_INPUT) {
        "standard input".to_owned()
    } else {
        path.display().to_string()
    }
}
