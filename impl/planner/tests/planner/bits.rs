//! Samples are the same to the last bit on every platform and in every build.

use gaugeblock_planner::{Axes, Dynamics, InputParameter, PathControl, Planner, Segment};

use super::check::{Feeding, dynamics, run_with};
use super::jerk::with_jerk;
use super::programs::{arcs, arcs_with_corners, helix, square, zig};

/// Digest of all bits of all samples (FNV-1a, 64 bits).
fn digest(dynamics: Dynamics, start: Axes, program: &[Segment]) -> u64 {
    let mut planner = Planner::new(dynamics, start).expect("limits");
    let input = |_| InputParameter::default();
    let samples = run_with(&mut planner, start, program, Feeding::Full, input).samples;
    let bytes = samples.iter().flatten().flat_map(|value| value.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[test]
fn samples_are_the_same_everywhere() {
    let origin = [0.0; 9];
    let (start, corners) = arcs_with_corners(PathControl::Within(0.1));
    let (plain, smooth) = (dynamics(), with_jerk(1e5));
    let digests = [
        digest(plain, origin, &zig(PathControl::Within(0.1))),
        digest(plain, origin, &square(PathControl::BetweenMidpoints)),
        digest(plain, origin, &arcs(PathControl::ExactPath)),
        digest(plain, origin, &helix(PathControl::Within(0.01))),
        digest(plain, start, &corners),
        digest(smooth, origin, &zig(PathControl::Within(0.1))),
        digest(smooth, origin, &square(PathControl::ExactStop)),
        digest(smooth, origin, &arcs(PathControl::ExactPath)),
        digest(smooth, start, &corners),
    ];
    // A change of the planner's behaviour updates these; a change of platform or compiler must not.
    let same = [
        0x4698_ae9e_2e1e_8970,
        0x5575_ddaf_f3c9_e9fd,
        0x1fee_a9a9_cd04_58f2,
        0xb1a0_23fc_4379_2c09,
        0x158b_954f_3a91_831d,
        0x5f09_070f_892d_2a41,
        0x2906_1ae4_73fe_ea81,
        0xaeee_6f4f_45c5_c21a,
        0x9852_e3da_e170_1452,
    ];
    assert_eq!(digests, same, "{digests:#018x?}");
}
