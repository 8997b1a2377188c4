//! Properties of the running program, for system variables.

use std::sync::Arc;

/// Names and position of the running program.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) struct ProgramInfo {
    pub(in crate::exec) main_file: Arc<str>,
    pub(in crate::exec) main_program: Arc<str>,
    pub(in crate::exec) file: Arc<str>,
    pub(in crate::exec) program: Arc<str>,
    /// 1 for the main program.
    pub(in crate::exec) level: u32,
    /// Last block number.
    pub(in crate::exec) block_number: u64,
    /// Offset of the block in its file.
    pub(in crate::exec) offset: u64,
    /// Nesting depth of cycles.
    pub(in crate::exec::program) cycles: u32,
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
