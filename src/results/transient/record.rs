//! Record of a transient, from which a longer run goes on.

use crate::results::record::Record;
use crate::transient::Recorder;

impl Record for Recorder {
    const FILE: &str = "record.bin";
    const MAGIC: [u8; 8] = *b"FRICSIMR";
    const VERSION: u32 = 4;

    fn inconsistency(&self) -> Option<&'static str> {
        (!self.is_consistent()).then_some("its samples, probes and frames do not fit together")
    }
}
