//! What system variables tell about the running program.

use std::sync::Arc;

/// Names and place of the running program.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ProgramInfo {
    pub(super) main_file: Arc<str>,
    pub(super) main_program: Arc<str>,
    pub(super) file: Arc<str>,
    pub(super) program: Arc<str>,
    /// 1 for the main program.
    pub(super) level: u32,
    /// Last block number.
    pub(super) block_number: u64,
    /// Offset of the block in its file.
    pub(super) offset: u64,
    /// Nesting depth of cycles.
    pub(super) cycles: u32,
}

impl Default for ProgramInfo {
    fn default() -> Self {
        let empty: Arc<str> = Arc::from("");
        Self {
            main_file: Arc::clone(&empty),
            main_program: Arc::clone(&empty),
            file: Arc::clone(&empty),
            program: empty,
            level: 1,
            block_number: 0,
            offset: 0,
            cycles: 0,
        }
    }
}
