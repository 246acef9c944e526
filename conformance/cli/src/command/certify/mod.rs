//! `gaugeblock certify`.

mod arguments;
mod course;
mod selection;
mod several;

use gaugeblock_suite::Suite;

pub(crate) use self::arguments::Arguments;
use self::course::Course;
pub(crate) use self::course::{print, write_report};
pub(crate) use self::selection::{known_profiles, known_rules};
use super::comparison::earlier_expectations;
use super::user_files;
use crate::arguments::Format;
use crate::error::CliError;
use crate::streams::{write_error, write_out};

/// Prints which certificate was written, after a report in text.
pub(crate) fn print_certificate(format: Format, written: &str) {
    match format {
        Format::Text => write_out(&format!("{written}\n")),
        Format::Json => write_error(written),
    }
}

pub(crate) fn certify(arguments: &Arguments, suite: &Suite) -> Result<u8, CliError> {
    if let Some(edition) = &arguments.edition {
        crate::documents::edition(suite, edition)?;
    }
    known_profiles(&arguments.profile, suite)?;
    if let names @ [_, _, ..] = arguments.controller.as_slice() {
        return several::certify(arguments, names, suite);
    }
    let course = Course {
        arguments,
        suite,
        known: arguments.against.read()?,
        earlier: earlier_expectations(arguments.write_expectations.as_deref())?,
        model: None,
    };
    let certificate = arguments.certificate.prepare(&arguments.against)?;
    let folder = arguments.report.as_deref();
    if let Some(folder) = folder {
        user_files::create_folder(folder)?;
    }
    let candidate = course.open(&arguments.controller.concat()).or_else(|error| {
        // A wrong call changes no file.
        if let Some(folder) = folder.filter(|_| error.status != CliError::WRONG_CALL) {
            course.set_aside(folder)?;
        }
        Err(error)
    })?;
    if arguments.list {
        return course.list(&candidate);
    }
    course.judge(&candidate, folder, |report| {
        print(report, arguments.format, arguments.detail.detail());
        if let Some(certificate) = certificate {
            let written = certificate.write(report)?;
            print_certificate(arguments.format, &written);
        }
        Ok(report.exit_status())
    })
}
