//! A program that is decoded on its own thread, ahead of the machine.
//!
//! Steps are handed over in parcels, of which few exist at a time, so the program is never far ahead. Where it reads
//! the state of the machine it hands over what it has and waits for an answer, see [`Live`](crate::exec::live::Live);
//! the machine answers when it needs the step that is being decoded. So every step is the one that would have been
//! decoded on demand. The thread ends with the program, and as soon as nobody takes its steps any more.

use super::executor::Executor;
use crate::exec::decoder::Decoder;
use crate::exec::step::{Ahead, Step, line};

/// The machine's end of a connection, and the work at the program's end.
pub(crate) fn connection() -> (Ahead, impl FnOnce(Box<Executor>) + Send + 'static) {
    let (ahead, line) = line();
    let work = move |mut executor: Box<Executor>| {
        let live = &mut executor.decoder.live;
        live.connect(line);
        loop {
            let decoded = executor.decode();
            let over = matches!(decoded.step, Step::End { .. });
            let Decoder { live, spare, .. } = &mut executor.decoder;
            let Some(line) = live.line() else { return };
            if !line.push(decoded, spare) {
                return;
            }
            if over {
                line.send(false);
                return;
            }
        }
    };
    (ahead, work)
}
