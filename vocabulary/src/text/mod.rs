//! The text form of an outcome, for people to read and write.
//!
//! ```text
//! gaugeblock outcome 0
//! language rs274
//! start units=mm plane=xy distance=absolute
//! block main.ngc:1
//!   set feed_rate=100
//!   do straight_feed end=(x1 y2)
//!   state motion=feed position=(x1 y2)
//! end program_end
//! parameters 31=5
//! pin digital_out[0] time=0 value=1
//! ```
//!
//! One line per record, `name=value` separated by blanks; texts are in double quotes with the escapes of JSON, and so
//! are file names and indices with other characters than letters, digits and a few signs. A field occurs once in a
//! line; the state is the last line of its block. A pin line is one change of one pin; time is virtual, in seconds.

pub(crate) mod line;
mod read;
pub(crate) mod value;
mod write;

pub use line::Arguments;
pub use value::{FromText, ReadArgument};
