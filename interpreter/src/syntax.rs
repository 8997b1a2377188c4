//! Text of a block to syntax tree; shape only, no meaning.

pub mod ast;
