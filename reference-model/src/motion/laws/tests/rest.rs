//! Exact stops, ends, dwells.

use super::*;

fn corner() -> ProgrammedPath {
    path(PathMode::ExactStop, Feed::PerSecond(50.0), vec![line(10.0, 0.0), line(20.0, 0.0)])
}

#[test]
fn a_stop_between_two_samples_is_a_stop() {
    for speed in [50.0, 49.3, 47.7] {
        let mut motion = Motion::default();
        motion.to(10.0, 0.0, speed).to(20.0, 0.0, speed);
        lawful(&judged(&motion.samples(), &corner()));
    }
}

/// Faults 23 and 24: a corner that is passed at speed, and at a speed that comes close to rest.
#[test]
fn a_stop_that_is_none() {
    for (speed, stops) in [(50.0, false), (1.5, false), (0.0, true)] {
        let mut motion = Motion::default();
        motion.line(xy(10.0, 0.0), (0.0, 50.0, speed), 1900.0);
        motion.line(xy(20.0, 0.0), (speed, 50.0, 0.0), 1900.0);
        let judgement = judged(&motion.samples(), &corner());
        if stops {
            lawful(&judgement);
        } else {
            broken(&judgement, Law::Stop);
        }
    }
}

/// Faults 25 to 28: a wrong start or end, and no rest there.
#[test]
fn a_record_starts_and_ends_at_rest_where_the_path_does() {
    let path = path(within(0.01), Feed::PerSecond(50.0), vec![line(10.0, 0.0)]);
    let good = Motion::default().to(10.0, 0.0, 50.0).samples();
    lawful(&judged(&good, &path));
    let mut shifted = good.clone();
    shifted.iter_mut().for_each(|point| point[0] += 0.001);
    let judgement = judged(&shifted, &path);
    let ends = judgement.violations().filter(|violation| violation.law == Law::Ends);
    assert_eq!(ends.count(), 2);
    broken(&judged(&good[..good.len() - 10], &path), Law::Ends);
    broken(&judged(&good[20..], &path), Law::Ends);
    let mut crawling = good;
    crawling.truncate(crawling.len() - 3);
    let last = crawling.len() - 1;
    crawling[last] = xy(10.0, 0.0).to_array();
    crawling[last - 1][0] = 9.99;
    broken(&judged(&crawling, &path), Law::Ends);
}

fn dwelling(seconds: f64) -> Vec<AxisVector> {
    let mut motion = Motion::default();
    motion.to(10.0, 0.0, 50.0).rest(seconds).to(20.0, 0.0, 50.0);
    motion.samples()
}

/// Faults 29 and 30: a dwell that is two cycles too short or too long.
#[test]
fn a_dwell_lasts_to_the_cycle() {
    let dwell = Shape::Dwell { seconds: 0.1 };
    let path =
        path(within(0.01), Feed::PerSecond(50.0), vec![line(10.0, 0.0), dwell, line(20.0, 0.0)]);
    for seconds in [0.1, 0.1003, 0.1009] {
        lawful(&judged(&dwelling(seconds), &path));
    }
    for seconds in [0.0, 0.098, 0.103] {
        broken(&judged(&dwelling(seconds), &path), Law::Dwell);
    }
}

/// Fault 31: no rest for something that is waited for.
#[test]
fn a_wait_is_at_rest() {
    let wait = Shape::Wait { for_what: "wait_input".to_owned() };
    let path =
        path(within(0.1), Feed::PerSecond(50.0), vec![line(10.0, 0.0), wait, line(20.0, 0.0)]);
    lawful(&judged(&dwelling(0.5), &path));
    broken(&judged(&Motion::default().to(20.0, 0.0, 50.0).samples(), &path), Law::Stop);
}
