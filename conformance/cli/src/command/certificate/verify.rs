//! `gaugeblock verify-certificate`.

use std::path::Path;

use gaugeblock_certificate::{Coverage, PublicKey, Statement, check, check_shards, sha256_of_file};
use gaugeblock_suite::Suite;

use super::arguments::Arguments;
use super::make::{now, signature_of};
use super::printed;
use super::rerun::rerun;
use super::verification::{Signed, Verification};
use crate::arguments::Format;
use crate::command::{certify, user_files};
use crate::error::CliError;
use crate::streams::write_out;

pub(crate) fn verify(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    certify::known_profiles(&arguments.profile, suite)?;
    let key = public_key(&arguments.public_key)?;
    let mut found = Verification::default();
    for file in &arguments.files {
        match signed(file, &key)? {
            Ok(certificate) => found.certificates.push(certificate),
            Err(problem) => found.problems.push(problem),
        }
    }
    check_contents(&mut found, suite);
    check_demands(&mut found, arguments)?;
    if found.problems.is_empty() {
        let statements: Vec<_> =
            found.certificates.iter().map(|signed| &signed.statement).collect();
        found.rerun = rerun(arguments, suite, &statements)?;
    }
    match arguments.format {
        Format::Text => write_out(&printed::text(&found)),
        Format::Json => write_out(&printed::json(&found)),
    }
    Ok(found.exit_status())
}

/// The public key of a file, or of the line that encodes it.
fn public_key(named: &str) -> Result<PublicKey, CliError> {
    let path = Path::new(named);
    if let (Ok(key), false) = (PublicKey::read(named), path.exists()) {
        return Ok(key);
    }
    let text = user_files::read_text(path, "public key (--public-key)")?;
    PublicKey::read(&text).map_err(|why| {
        CliError::usage(
            format!("{named} {why}"),
            "name the file minisign.pub of `minisign -G`, or its second line",
        )
    })
}

/// A certificate whose signature is valid, or why it is not. Nothing of a file without a valid signature is read.
fn signed(file: &Path, key: &PublicKey) -> Result<Result<Signed, String>, CliError> {
    let name = file.display().to_string();
    let bytes = user_files::read_bytes(file, "certificate")?;
    let signature = signature_of(file);
    let signature = user_files::read_bytes(&signature, "signature: it is next to the certificate")?;
    let signature = String::from_utf8_lossy(&signature);
    let comment = match key.verify(&bytes, &signature) {
        Ok(comment) => comment,
        Err(why) => return Ok(Err(format!("{name}: signature: {why}"))),
    };
    let statement = Statement::read(&String::from_utf8_lossy(&bytes));
    let signed =
        statement.map(|statement| Signed { file: name.clone(), key: key.id(), comment, statement });
    Ok(signed.map_err(|why| format!("{name} {why}")))
}

/// Checks what the certificates say.
fn check_contents(found: &mut Verification, suite: &Suite) {
    let (now, is_one) = (now(), found.certificates.len() == 1);
    for Signed { file, statement, .. } in &found.certificates {
        let checked = check(statement, suite, &now);
        let placed = |text: String| if is_one { text } else { format!("{file}: {text}") };
        found.problems.extend(checked.problems.into_iter().map(placed));
        found.notes.extend(checked.notes.into_iter().map(placed));
    }
    let parts = found.certificates.iter();
    let parts: Vec<_> =
        parts.map(|signed| (signed.file.clone(), signed.statement.clone())).collect();
    found.problems.extend(check_shards(&parts));
}

/// Checks what the call demands of them.
fn check_demands(found: &mut Verification, arguments: &Arguments) -> Result<(), CliError> {
    let predicates = found.certificates.iter().map(|signed| &signed.statement.predicate);
    let is_partial = predicates.clone().any(|predicate| predicate.coverage == Coverage::Partial);
    let mut problems = Vec::new();
    if is_partial && !arguments.partial {
        problems.push(
            "coverage: partial, only a selection of the cases was run; --partial accepts that"
                .to_owned(),
        );
    }
    let passed = |wanted: &String| {
        let mut profiles = predicates.clone().flat_map(|predicate| &predicate.profiles);
        profiles.any(|profile| profile.profile == *wanted && profile.claimed && profile.passes)
    };
    let missing = arguments.profile.iter().filter(|wanted| !passed(wanted));
    problems
        .extend(missing.map(|profile| format!("profiles: {profile} is not claimed and passed")));
    for file in &arguments.subject {
        let digest = sha256_of_file(file).map_err(|error| {
            CliError::usage(format!("{}: {error}", file.display()), "check the path of --subject")
        })?;
        let mut certified = found.certificates.iter().flat_map(|signed| &signed.statement.subject);
        if !certified.any(|subject| subject.digest.sha256 == digest) {
            problems.push(format!(
                "subject: {} has the digest {digest}, which is not certified",
                file.display()
            ));
        }
    }
    found.problems.extend(problems);
    Ok(())
}
