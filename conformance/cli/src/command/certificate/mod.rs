//! Certificates: `--certificate` of `certify` and `report merge`, and `gaugeblock verify-certificate`.

mod arguments;
mod files;
mod make;
mod printed;
mod rerun;
mod verification;
mod verify;

pub(crate) use arguments::Arguments;
pub(crate) use files::controller_files;
pub(crate) use make::CertificateArguments;
pub(crate) use verify::verify;
