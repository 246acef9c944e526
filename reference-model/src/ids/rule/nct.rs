//! Each rule of `nct`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::NCT;

    /// Whatever a macro does to `#1` to `#33`, those of the calling program are the same after it.
    ANY_BODY = "nct.any-body",
    /// G2 and G3 go round a centre, which I, J and K give from the start, or with the radius R.
    ARC = "nct.arc",
    /// A, B and C, and ten sets of I, J and K, are `#1` to `#33`; of two words for one variable the later one
    /// counts.
    ARGUMENT_SETS = "nct.argument-sets",
    /// Each letter of a call except G, L, N, O and P stands for a local variable of its own, and the code
    /// comes before them.
    ARGUMENTS = "nct.arguments",
    /// NOT, AND, OR and XOR take whole numbers of 32 bits: 3091 ERRONEOUS OPERATION WITH `#` where there is
    /// none.
    BITS = "nct.bits",
    /// A block that begins with a slash is skipped where block delete is on.
    BLOCK_DELETE = "nct.block-delete",
    /// Of several modal calls by block the one that was commanded last is called in entering each block, with
    /// the words of that block as arguments.
    BLOCK_LAST_FIRST = "nct.block-last-first",
    /// The modal call by block before is then called in entering the blocks of that macro, with their words
    /// as arguments.
    BLOCK_THEN_EARLIER = "nct.block-then-earlier",
    /// Brackets are nested up to five deep, those of functions, indices and conditions counted: 3064 BAD
    /// MACRO STATEMENT.
    BRACKETS = "nct.brackets",
    /// G65 calls the program P at once, as a macro with its arguments.
    CALL = "nct.call",
    /// A further G67 cancels the modal call before; after the last one a motion calls nothing.
    CANCEL_EARLIER = "nct.cancel-earlier",
    /// G67 cancels the modal call that was commanded last.
    CANCEL_LAST = "nct.cancel-last",
    /// G67 without a modal call in force does nothing.
    CANCEL_NOTHING = "nct.cancel-nothing",
    /// `#100` to `#199` and `#500` to `#599` are common to all levels: no call stores them.
    COMMON = "nct.common",
    /// EQ, NE, GT, LT, GE and LE compare two values; if the comparison is true, IF continues at the block
    /// that its GOTO names.
    CONDITIONS = "nct.conditions",
    /// G4 waits for P.
    DWELL = "nct.dwell",
    /// Main program and macros of the levels 1 to 4 have five sets of `#1` to `#33`, none of which touches
    /// another.
    FIVE_SETS = "nct.five-sets",
    /// Besides COS and NOT there are SIN, TAN, ASIN, ACOS, ATAN, SQRT, ABS, ROUND, FIX, FUP, LN and EXP, and
    /// MOD; angles are in degrees.
    FUNCTIONS = "nct.functions",
    /// GOTO goes to the block of that number in the same program: 3070 NOT EXISTING BLOCK NO. P where there
    /// is none.
    GOTO = "nct.goto",
    /// The number of a variable is computed in brackets.
    INDIRECT = "nct.indirect",
    /// There are four macro levels, macros that are called once and modally counted together; eight calls in
    /// all, subprograms included.
    LEVEL_LIMIT = "nct.level-limit",
    /// A macro that is called from a macro has local variables one level above.
    LEVEL_RISES = "nct.level-rises",
    /// The number of a loop is 1, 2 or 3.
    LOOP_NUMBER = "nct.loop-number",
    /// Each DO has its END in the program, each END its DO, and loops do not overlap.
    LOOP_PAIRS = "nct.loop-pairs",
    /// WHILE with a condition and DO m executes the blocks up to END m as long as it holds.
    LOOPS = "nct.loops",
    /// M99 in the main program begins it again, for ever; with P it goes on at that block.
    MAIN_RETURN = "nct.main-return",
    /// The block of G66 stores the arguments and calls nothing; each interpolation after it calls the macro
    /// with them.
    MODAL_CALL = "nct.modal-call",
    /// Modal calls raise the level too, so that their macros have local variables of their own.
    MODAL_LEVELS = "nct.modal-levels",
    /// After each interpolation the last of the modal calls that its block reaches is called; the blocks of a
    /// macro reach those that were commanded before it.
    MODAL_ORDER = "nct.modal-order",
    /// G17 to G19, G20, G21, G54 to G59, G90, G91, G94, G95, M3 to M9, F, S and T set what they set in other
    /// languages; a block has one code of a group.
    MODES = "nct.modes",
    /// G0 and G1 move to where words of axes say, in absolute distance mode, or by as much, in incremental
    /// mode; the code holds until another one comes.
    MOTION = "nct.motion",
    /// O, N and the slash of block delete take no variable.
    PLAIN_NUMBERS = "nct.plain-numbers",
    /// A function comes before multiplication, division and AND, and those before addition, subtraction, OR
    /// and XOR; equals from the left.
    PRECEDENCE = "nct.precedence",
    /// L says how often a program is called, 1 to 9999; without it, once.
    REPEAT = "nct.repeat",
    /// M99 brings back the local variables of the calling program as they were when they were stored, vacant
    /// ones too.
    RESTORED = "nct.restored",
    /// M99 with P goes on at the block of that number in the calling program.
    RETURN_TO = "nct.return-to",
    /// A sequence number opens its block.
    SEQUENCE_NUMBER = "nct.sequence-number",
    /// A macro statement has one of the forms of this chapter, and its block has nothing else: 3064 BAD MACRO
    /// STATEMENT.
    STATEMENT_FORM = "nct.statement-form",
    /// A call from a level stores its local variables, and the next level takes the arguments: from level 1
    /// and from each level above.
    STORED_AT_EACH_LEVEL = "nct.stored-at-each-level",
    /// On the first call the local variables of the main program are stored; those of the macro are the
    /// arguments, the others are vacant.
    STORED_ON_CALL = "nct.stored-on-call",
    /// M98 calls the program P after the rest of its block; it has the local variables of its caller, and the
    /// level stays.
    SUB_CALL = "nct.sub-call",
    /// M2 or M30 ends the run, in whichever program; a program whose text ends before an end or M99 is
    /// refused.
    TEXT_END = "nct.text-end",
    /// `#0` holds nothing, for ever. A vacant variable is copied as vacant, and counts as zero in arithmetic.
    VACANT = "nct.vacant",
    /// Vacant is equal to vacant alone, to no number, and is greater than zero.
    VACANT_COMPARISON = "nct.vacant-comparison",
    /// A word with a vacant value is left out.
    VACANT_WORD = "nct.vacant-word",
    /// There are `#1` to `#33`, `#100` to `#199` and `#500` to `#599`; greater numbers may be those of system
    /// variables and stay open.
    VARIABLE_NUMBERS = "nct.variable-numbers",
    /// A value that is out of the range of its letter is refused.
    WORD_RANGE = "nct.word-range",
    /// The value of a variable is rounded to the digits that the letter of its word has.
    WORD_ROUNDING = "nct.word-rounding",
}
