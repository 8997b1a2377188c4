//! The names that a page calls. Texts are UTF-8; addresses hold until the next call.
//!
//! Order of calls: first [`request`] makes room, the page writes its text there; then [`check`], [`explain`] or [`start`] reads it.
//! Every one of them, and [`finish`], leaves an answer: [`answer_length`] bytes at [`answer`]. A started run is continued by [`advance`]
//! until that returns 0; then come [`finish`] and the columns, [`rows`] values at each [`column()`]. A page calls these names on the
//! module of wasm32 and writes into its memory; the same calls from Rust:
//!
//! ```
//! use kontur_browser::exported::{advance, answer, answer_length, column, finish, request, rows, start};
//!
//! fn send(text: &str) {
//!     let room = request(text.len());
//!     assert!(!room.is_null(), "a request has at most 4 MiB");
//!     // SAFETY: `request` has just made this room for as many bytes, and nothing was called since.
//!     unsafe { room.copy_from_nonoverlapping(text.as_ptr(), text.len()) };
//! }
//!
//! fn answered() -> String {
//!     // SAFETY: an answer lies where `answer` says until the next call.
//!     let bytes = unsafe { std::slice::from_raw_parts(answer(), answer_length()) };
//!     String::from_utf8_lossy(bytes).into_owned()
//! }
//!
//! send(r#"{ "program": "N10 G01 X10 F6000\nN20 M30\n", "signals": "X_set_mm" }"#);
//! start();
//! assert!(answered().contains(r#""refused":false"#));
//! while advance(1000) == 1 {}
//! finish();
//! assert!(answered().contains(r#""state":"finished""#));
//! // SAFETY: a column has `rows` values and holds until the next call.
//! let x = unsafe { std::slice::from_raw_parts(column(0), rows()) };
//! assert_eq!(x.last(), Some(&10.0));
//! ```

#![expect(unsafe_code, reason = "a name for another language is an unsafe attribute")]

use crate::Session;
use std::cell::RefCell;
use std::panic::{PanicHookInfo, set_hook};
use std::sync::Once;

/// Longest request in bytes.
const REQUEST_MAX: usize = 4 << 20;

#[derive(Default)]
struct State {
    session: Session,
    request: Vec<u8>,
    answer: String,
}

thread_local! {
    static STATE: RefCell<State> = RefCell::default();
    /// The message of the module when it stopped; it can still be read then.
    static LAST_WORDS: RefCell<String> = const { RefCell::new(String::new()) };
}

fn remember(panic: &PanicHookInfo<'_>) {
    LAST_WORDS.with_borrow_mut(|words| *words = panic.to_string());
}

fn with<T>(f: impl FnOnce(&mut State) -> T) -> T {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| set_hook(Box::new(remember)));
    STATE.with_borrow_mut(f)
}

fn answered(f: impl FnOnce(&mut Session, &str) -> String) {
    with(|state| {
        let text = String::from_utf8_lossy(&state.request);
        state.answer = f(&mut state.session, &text);
    });
}

/// Room for a request of the given number of bytes; null if that is too long.
#[unsafe(no_mangle)]
pub extern "C" fn request(bytes: usize) -> *mut u8 {
    with(|state| {
        if bytes > REQUEST_MAX {
            return std::ptr::null_mut();
        }
        state.request = vec![0; bytes];
        state.request.as_mut_ptr()
    })
}

/// [`Session::check`] of the request.
#[unsafe(no_mangle)]
pub extern "C" fn check() {
    answered(|session, request| session.check(request));
}

/// [`Session::explain`] of the request.
#[unsafe(no_mangle)]
pub extern "C" fn explain() {
    answered(|session, request| session.explain(request));
}

/// [`Session::start`] of the request.
#[unsafe(no_mangle)]
pub extern "C" fn start() {
    answered(Session::start);
}

/// [`Session::advance`]; 1 while there are more cycles.
#[unsafe(no_mangle)]
pub extern "C" fn advance(cycles: u32) -> u32 {
    with(|state| u32::from(state.session.advance(cycles)))
}

/// [`Session::finish`].
#[unsafe(no_mangle)]
pub extern "C" fn finish() {
    answered(|session, _| session.finish());
}

/// Address of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    with(|state| state.answer.as_ptr())
}

/// Its length in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn answer_length() -> usize {
    with(|state| state.answer.len())
}

/// Address of [`Session::column`].
#[unsafe(no_mangle)]
pub extern "C" fn column(i: usize) -> *const f64 {
    with(|state| state.session.column(i).as_ptr())
}

/// Its number of values.
#[unsafe(no_mangle)]
pub extern "C" fn rows() -> usize {
    with(|state| state.session.column(0).len())
}

/// Address of the reason why the module stopped.
#[unsafe(no_mangle)]
pub extern "C" fn last_words() -> *const u8 {
    LAST_WORDS.with_borrow(|words| words.as_ptr())
}

/// Its length in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn last_words_length() -> usize {
    LAST_WORDS.with_borrow(String::len)
}
