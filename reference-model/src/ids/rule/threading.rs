//! Each rule of `threading`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::THREADING;

    /// G33 and G33.1 need an axis word.
    AXIS_WORDS_MISSING = "threading.axis-words-missing",
    /// The first pass of G76 is J beyond the crest of the thread and the last one K; passes between are as
    /// deep each as the first under R1, and cut as large an area each as the first under R2.
    DEGRESSION = "threading.degression",
    /// G33 and G33.1 need K in each block.
    NEEDS_PITCH = "threading.needs-pitch",
    /// G33 and G33.1 are refused while the spindle does not turn.
    NEEDS_SPINDLE = "threading.needs-spindle",
    /// G33.1 moves synchronised with the spindle to its end point and back, and ends where it began.
    RIGID_TAP = "threading.rigid-tap",
    /// $ of G33 and G33.1 names the spindle, one that the machine has; without it that is spindle 0.
    SPINDLE = "threading.spindle",
    /// H of G76 adds as many passes at full depth.
    SPRING_PASSES = "threading.spring-passes",
    /// G33 moves straight to its end point, by K for each revolution of the spindle, and ends there.
    SYNCHRONISED = "threading.synchronised",
    /// G76 cuts a thread in passes from where the controlled point is, on the drive line, to Z: each
    /// traverses to its depth, feeds along Z by P for each revolution of the spindle, traverses out to the
    /// drive line and back to its beginning; the last one stays at its end.
    THREAD = "threading.thread",
    /// G76 takes no axis word other than Z.
    THREAD_AXIS_WORDS = "threading.thread-axis-words",
    /// A degression R of G76 below 1 is refused.
    THREAD_DEGRESSION = "threading.thread-degression",
    /// In diameter mode I, J and K of G76 are diameters, in radius mode radii.
    THREAD_DIAMETER = "threading.thread-diameter",
    /// A negative P, J, K or H of G76 is refused.
    THREAD_NEGATIVE = "threading.thread-negative",
    /// G76 is refused in a plane other than ZX.
    THREAD_PLANE = "threading.thread-plane",
    /// Q of G76 is an angle by which passes move along the drive line: the deeper a pass the further on it
    /// begins.
    THREAD_SLIDE = "threading.thread-slide",
    /// E of G76 is not more than half the length of the thread.
    THREAD_TAPER = "threading.thread-taper",
    /// L of G76 gives the thread a taper of the length E at its entry (1), its exit (2) or both (3). There
    /// each pass feeds along a slope of the full depth over E, and still P along Z for each revolution. At an
    /// entry it feeds in from the drive line.
    THREAD_TAPERS = "threading.thread-tapers",
    /// G76 needs P, Z, I, J and K.
    THREAD_WORDS = "threading.thread-words",
    /// G33 and G33.1 are refused when the speed of the spindle would have an axis exceed its highest
    /// velocity.
    VELOCITY = "threading.velocity",
}
