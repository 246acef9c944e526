//! Points in time, as a certificate writes them.

use gaugeblock_runner::waivers::Day;

const SECONDS_PER_DAY: u64 = 86_400;

/// A point in time, seconds after 1970 began, as `2026-11-30T09:05:00Z`.
pub fn utc_time(seconds: u64) -> String {
    let (day, second) = (Day::after_epoch(seconds / SECONDS_PER_DAY), seconds % SECONDS_PER_DAY);
    format!("{day}T{:02}:{:02}:{:02}Z", second / 3600, second / 60 % 60, second % 60)
}

/// Whether a text is a point in time as [`utc_time`] writes it. Such texts have the order of the points in time.
pub(crate) fn is_time(text: &str) -> bool {
    let Some((day, time)) = text.strip_suffix('Z').and_then(|text| text.split_once('T')) else {
        return false;
    };
    let numbers: Vec<u8> = time.split(':').filter_map(|part| part.parse().ok()).collect();
    let [hour, minute, second] = numbers[..] else { return false };
    let is_written_so = format!("{hour:02}:{minute:02}:{second:02}") == time;
    day.parse::<Day>().is_ok() && hour < 24 && minute < 60 && second < 60 && is_written_so
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_read_as_it_is_written_and_nothing_else_is() {
        assert_eq!(utc_time(0), "1970-01-01T00:00:00Z");
        assert_eq!(utc_time(1_796_029_508), "2026-11-30T09:05:08Z");
        for seconds in [0, 86_399, 86_400, 1_796_029_508] {
            assert!(is_time(&utc_time(seconds)), "{seconds}");
        }
        for wrong in [
            "",
            "2026-11-30",
            "2026-02-30T00:00:00Z",
            "2026-11-30T24:00:00Z",
            "2026-11-30T9:05:08Z",
        ] {
            assert!(!is_time(wrong), "{wrong}");
        }
    }
}
