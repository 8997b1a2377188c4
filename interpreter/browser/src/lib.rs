//! The library for a page in a browser.
//!
//! [`Session`] takes requests and gives answers as JSON; [`exported`] are the names under which a page calls it. Order of calls: a
//! text of [`exported::request`] bytes is written, then [`exported::check`], [`exported::explain`] or [`exported::start`] reads it
//! and leaves an answer ([`exported::answer`], [`exported::answer_length`]). A started run continues with [`exported::advance`] until
//! that returns 0; [`exported::finish`] answers with its summary, and [`exported::column`] is where its columns lie.
//!
//! ```
//! use kontur_browser::Session;
//!
//! let mut session = Session::default();
//! let request = r#"{ "program": "N10 G01 X10 F6000\nN20 M30\n", "signals": "X_set_mm" }"#;
//! assert!(session.start(request).contains(r#""refused":false"#));
//! while session.advance(1000) {}
//! assert!(session.finish().contains(r#""state":"finished""#));
//! assert_eq!(session.column(0).last(), Some(&10.0));
//! ```

pub mod exported;
mod session;

pub use session::Session;
