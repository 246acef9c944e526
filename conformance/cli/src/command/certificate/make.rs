//! Making a certificate: the key is read before anything runs, and nothing is written before all of it is there.

use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use clap::Args;
use gaugeblock_certificate::{
    AcceptanceList, CertifiedShard, Circumstances, Host, PREDICATE_TYPE, SIGNATURE_SUFFIX,
    SigningKey, Statement, Tool, utc_time,
};
use gaugeblock_report::Report;

use super::files::digest_of;
use crate::command::comparison::ComparisonArguments;
use crate::command::user_files;
use crate::error::CliError;

const KEY: &str = "secret key (--key)";

#[derive(Debug, Args)]
pub(crate) struct CertificateArguments {
    /// Write a certificate of the run, an in-toto statement, to this file, and its signature to FILE.minisig
    #[arg(long, value_name = "FILE")]
    pub(crate) certificate: Option<PathBuf>,
    /// Sign the certificate with this secret key of minisign [default: not signed; `minisign -Sm FILE` signs it]
    #[arg(long, value_name = "FILE", requires = "certificate")]
    key: Option<PathBuf>,
    /// Read the password of the key from the first line of this file [default: from the terminal]
    #[arg(long, value_name = "FILE", requires = "key")]
    key_password: Option<PathBuf>,
}

/// A certificate that is to be made after a run.
#[derive(Debug)]
pub(crate) struct WantedCertificate {
    file: PathBuf,
    key: Option<SigningKey>,
    tool: Tool,
    lists: Vec<AcceptanceList>,
    started: String,
}

impl CertificateArguments {
    /// Reads the key and the lists, before anything runs; nothing if no certificate is wanted.
    pub(crate) fn prepare(
        &self,
        against: &ComparisonArguments,
    ) -> Result<Option<WantedCertificate>, CliError> {
        let Some(file) = &self.certificate else { return Ok(None) };
        let inputs: Vec<PathBuf> =
            self.key.iter().chain(&self.key_password).cloned().chain(against.files()).collect();
        let signature = signature_of(file);
        let outputs =
            [("--certificate", Some(file.as_path())), ("--certificate", Some(signature.as_path()))];
        user_files::check_outputs_spare_inputs(&inputs, &outputs)?;
        Ok(Some(WantedCertificate {
            file: file.clone(),
            key: self.key.as_deref().map(|key| self.read_key(key)).transpose()?,
            tool: tool()?,
            lists: against.lists()?,
            started: now(),
        }))
    }

    fn read_key(&self, path: &Path) -> Result<SigningKey, CliError> {
        let text = user_files::read_text(path, KEY)?;
        let password = match &self.key_password {
            _ if !SigningKey::is_encrypted(&text) => None,
            Some(file) => {
                let text = user_files::read_text(file, "password (--key-password)")?;
                Some(text.lines().next().unwrap_or_default().to_owned())
            }
            None => Some(typed_password(path)?),
        };
        SigningKey::read(&text, password).map_err(|why| {
            CliError::usage(
                format!("{} {why}", path.display()),
                "`minisign -G` makes a pair of keys; --key takes the secret one, minisign.key",
            )
        })
    }
}

fn typed_password(path: &Path) -> Result<String, CliError> {
    rpassword::prompt_password(format!("Password of {}: ", path.display())).map_err(|error| {
        CliError::usage(
            format!(
                "{}: the key has a password, and no terminal can be read: {error}",
                path.display()
            ),
            "name a file with the password with --key-password, or sign later: `minisign -Sm FILE`",
        )
    })
}

impl WantedCertificate {
    /// Makes the certificate of a run that has just ended, and writes it. Returns what was written, in a line.
    pub(crate) fn write(self, report: &Report<'_>) -> Result<String, CliError> {
        let started = Some(self.started.clone());
        self.write_of(report, started, Vec::new())
    }

    /// Makes the certificate of a run whose shards were merged, and writes it. Returns what was written, in a line.
    pub(crate) fn write_merged(
        self,
        report: &Report<'_>,
        shards: Vec<CertifiedShard>,
    ) -> Result<String, CliError> {
        self.write_of(report, None, shards)
    }

    fn write_of(
        self,
        report: &Report<'_>,
        started: Option<String>,
        shards: Vec<CertifiedShard>,
    ) -> Result<String, CliError> {
        let Self { file, key, tool, lists, .. } = self;
        let made = now();
        let circumstances = Circumstances { tool, host: host(), lists, shards, started, made };
        let statement = Statement::of(report, circumstances).map_err(|why| {
            CliError::failure(
                format!("{}: no certificate was written: {why}", file.display()),
                "a certificate needs --subject FILE or files of the adapter, and cases that do not disturb others",
            )
        })?;
        let text = statement.to_text();
        let name = file.display().to_string();
        let Some(key) = key else {
            user_files::write_whole(&file, &text)?;
            return Ok(format!("certificate: {name}, not signed; sign it: minisign -Sm {name}"));
        };
        let comment = format!("{PREDICATE_TYPE} made {}", statement.predicate.made);
        let signed = key.sign(&text, &comment).map_err(|why| {
            CliError::failure(
                format!("{name}: not signed: {why}"),
                "no certificate was written; repeat the call",
            )
        })?;
        let signature = signature_of(&file);
        user_files::write_together(&[(&file, text.as_bytes()), (&signature, signed.as_bytes())])?;
        Ok(format!(
            "certificate: {name}, signed with key {} ({}); public key {}",
            key.id(),
            signature.display(),
            key.public_key()
        ))
    }
}

/// The file of a signature.
pub(super) fn signature_of(file: &Path) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(SIGNATURE_SUFFIX);
    PathBuf::from(name)
}

/// This program.
fn tool() -> Result<Tool, CliError> {
    let program = std::env::current_exe().map_err(|error| {
        CliError::failure(format!("this program cannot be found: {error}"), "start it by its path")
    })?;
    Ok(Tool {
        name: "gaugeblock".to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        sha256: digest_of(&program, "program")?,
    })
}

/// This machine, without what would name it or its user.
fn host() -> Host {
    let kernel = std::fs::read_to_string("/proc/sys/kernel/osrelease").ok();
    Host {
        system: std::env::consts::OS.to_owned(),
        kernel: kernel.map(|version| version.trim().to_owned()),
        architecture: std::env::consts::ARCH.to_owned(),
        processors: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
    }
}

/// The present point in time.
#[expect(clippy::disallowed_methods, reason = "a certificate is made at a point in time")]
pub(super) fn now() -> String {
    utc_time(SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs()))
}
