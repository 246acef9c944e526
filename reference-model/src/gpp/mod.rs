//! GPP: the variables of a post-processor, their modality and set status.
//!
//! | room | what it settles |
//! | --- | --- |
//! | [`text`] | words, numbers, texts and signs of a program; comments |
//! | [`formats`] | how a number is printed, rounded and read back |
//! | [`variables`] | variables as they are declared, their values and flags |
//! | [`toolpath`] | the file that drives a program |
//! | [`syntax`] | what a program may look like; all that is refused before it runs |
//! | [`evaluate`] | references, expressions, conditions |
//! | [`status`] | what turns a variable on and off |
//! | [`mod@print`] | OUTPUT and PRINT |
//! | [`record`] | steps, state, budget |
//! | [`mod@run`] | the toolpath processed block by block, statement by statement |
//!
//! What a scenario and a trace are in this language says `README.md` beside the pages of its rules.
pub mod evaluate;
pub mod formats;
pub mod print;
pub mod record;
pub mod refusal;
pub mod run;
pub mod status;
pub mod syntax;
pub mod text;
pub mod toolpath;
pub mod variables;

pub use run::run;
