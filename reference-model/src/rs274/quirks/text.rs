//! Quirks of reading text, words and expressions.
