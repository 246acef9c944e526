//! NCT custom macros: calls at once and modal, levels of local variables, vacant values, and the motion that shows
//! them.
//!
//! | room | what it settles |
//! | --- | --- |
//! | [`text`] | lines, comments, blanks, block delete, program and sequence numbers |
//! | [`syntax`] | what a block may look like: words, macro statements, expressions |
//! | [`programs`] | programs by number, blocks by sequence number, loops |
//! | [`variables`] | local variables by level, common variables, vacant |
//! | [`evaluate`] | expressions and conditions |
//! | [`words`] | the words of a block: rounded, in range, vacant ones left out |
//! | [`frames`] | programs in progress, modal calls in force |
//! | [`arguments`] | which local variable takes which word of a call |
//! | [`calls`] | macro calls, modal calls, subprograms, returns |
//! | [`modes`] | G and M codes: groups, modes in force |
//! | [`motion`] | G0 to G3: where a move ends, and round which centre |
//! | [`record`] | steps, settings, state, budget |
//! | [`state`] | the state of a run |
//! | [`mod@run`] | the run: block by block |
//!
//! What a program and a trace are in this language says `README.md` beside the pages of its rules.

pub mod arguments;
pub mod calls;
pub mod evaluate;
pub mod frames;
pub mod modes;
pub mod motion;
pub mod programs;
pub mod record;
pub mod refusal;
pub mod run;
pub mod state;
pub mod syntax;
pub mod text;
pub mod variables;
pub mod words;

pub use run::run;
