//! `gaugeblock certify`.

mod arguments;
mod course;
mod selection;
mod several;

use gaugeblock_suite::Suite;

pub(crate) use self::arguments::Arguments;
use self::course::Course;
pub(crate) use self::course::{print, progress, write_report};
pub(crate) use self::selection::{known_profiles, known_rules};
use super::comparison::earlier_expectations;
use super::user_files;
use crate::error::CliError;

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
    let folder = arguments.report.as_deref();
    if let Some(folder) = folder {
        user_files::create_folder(folder)?;
    }
    let candidate = course.open(&arguments.controller.concat())?;
    if arguments.list {
        return course.list(&candidate);
    }
    course.judge(&candidate, folder, |report| {
        print(report, arguments.format, arguments.detail.detail());
        Ok(report.exit_status())
    })
}
