//! The planner alone: segments in, one position per servo cycle out, as CSV.
//!
//! `cargo run -p gaugeblock-examples --bin planner > samples.csv`
#![expect(clippy::print_stdout, reason = "an example prints what it does")]

use gaugeblock_planner::{
    Axes, Dynamics, Feed, InputParameter, OutputParameter, Path, PathControl, Phase, Planner,
    Segment,
};

/// Seconds of a servo cycle.
const CYCLE_S: f64 = 0.001;

/// End points X, Y in millimetres: a square with an edge of 20 mm.
const CORNERS: [[f64; 2]; 4] = [[20.0, 0.0], [20.0, 20.0], [0.0, 20.0], [0.0, 0.0]];

fn at([x, y]: [f64; 2]) -> Axes {
    [x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let dynamics = Dynamics {
        velocity: [250.0; 9],
        acceleration: [2000.0; 9],
        jerk: None,
        cycle: CYCLE_S,
        queue: 16,
    };
    let mut planner =
        Planner::new(dynamics, at([0.0, 0.0])).map_err(|error| format!("limits: {error:?}"))?;
    for (number, corner) in (0..).zip(CORNERS) {
        let segment = Segment {
            number,
            path: Path::Straight { end: at(corner) },
            feed: Feed::PerSecond(100.0),
            // Corners may be rounded by a tenth of a millimetre.
            path_control: PathControl::Within(0.1),
            probing: false,
        };
        planner.queue(&segment).map_err(|error| format!("segment {number}: {error:?}"))?;
    }
    println!("time,x,y,speed");
    let mut output = OutputParameter::default();
    for cycle in 1_u32.. {
        // The operator lowers the feed override to 50 % from 0.1 s to 0.3 s.
        let slow = (100..300).contains(&cycle);
        let input = InputParameter {
            feed_override: if slow { 0.5 } else { 1.0 },
            ..InputParameter::default()
        };
        let phase = planner.update(&input, &mut output);
        let [x, y, ..] = output.position;
        println!("{:.3},{x},{y},{}", f64::from(cycle) * CYCLE_S, output.speed);
        if phase == Phase::Idle {
            break;
        }
    }
    Ok(())
}
