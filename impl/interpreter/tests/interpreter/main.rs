//! The interpreter as an embedder calls it.

mod saved_state;
