//! Certificates: what a run of the suite found, as a signed statement that others can check.
//!
//! A certificate is an [in-toto statement](Statement) about the files of a controller. It has each case's verdict;
//! counts, verdicts of rules and profiles follow from them, and [`check()`] derives them again. A
//! [signature](SigningKey) in the format of minisign is a file next to it.
//!
//! **Invariant:** a statement has one form. What [`Statement::read`] accepts is, byte for byte, what
//! [`Statement::to_text`] writes, so that no two readers can understand one certificate in two ways.

mod case;
mod check;
mod digest;
mod make;
mod sample;
mod shards;
mod signature;
mod statement;
mod time;

pub use case::{CaseVerdict, CertifiedCase, CertifiedDivergence};
pub use check::{Checked, check};
pub use digest::{sha256, sha256_of_file};
pub use make::Circumstances;
pub use sample::{Change, changes, sample};
pub use shards::check_shards;
pub use signature::{PublicKey, SIGNATURE_SUFFIX, SigningKey};
pub use statement::{
    AcceptanceList, CertifiedProfile, CertifiedRule, CertifiedShard, Coverage, Digest, Host,
    ListKind, PREDICATE_TYPE, Predicate, RunResult, STATEMENT_TYPE, Seeds, Statement, Subject,
    SubjectAnnotations, Tool, schema,
};
pub use time::utc_time;
