//! Each rule of `subroutines`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::SUBROUTINES;

    /// A call with more than 30 arguments is refused.
    ARGUMENT_LIMIT = "subroutines.argument-limit",
    /// A call passes up to 30 arguments, which the sub finds in `#1`, `#2` and so on.
    ARGUMENTS = "subroutines.arguments",
    /// Arguments are written in square brackets.
    ARGUMENTS_IN_BRACKETS = "subroutines.arguments-in-brackets",
    /// The blocks between sub and endsub are not executed until the sub is called.
    BODY_SKIPPED = "subroutines.body-skipped",
    /// A call executes the body of the sub and goes on with the block after the call.
    CALL = "subroutines.call",
    /// The parameter `#<_call_level>` is the number of nested calls.
    CALL_LEVEL = "subroutines.call-level",
    /// The local named parameters of a caller, the main program's too, are not visible in the sub.
    CALLER_LOCALS = "subroutines.caller-locals",
    /// A sub can call other subs.
    CALLS_OTHER_SUBS = "subroutines.calls-other-subs",
    /// The number of a call can be given by a parameter or an expression.
    COMPUTED_O_WORDS = "subroutines.computed-o-words",
    /// A sub can be called only after its definition.
    DEFINED_BEFORE_CALL = "subroutines.defined-before-call",
    /// A call of a sub that the program does not define runs the file of that name.
    FILE_CALL = "subroutines.file-call",
    /// A fault in a called file is a fault of the run.
    FILE_FAULT = "subroutines.file-fault",
    /// The file of a sub is sought in the folder of programs and in the search path; one in another folder
    /// does not count.
    FILE_FOLDER = "subroutines.file-folder",
    /// The name of a file called is made lower case.
    FILE_NAME_CASE = "subroutines.file-name-case",
    /// A call by number runs the file named by that number.
    FILE_NUMBERED = "subroutines.file-numbered",
    /// A file that is called defines one sub, of the file's name, and no other.
    FILE_ONE_SUB = "subroutines.file-one-sub",
    /// A sub can read and change global named parameters, and its caller sees the change.
    GLOBAL_NAMED = "subroutines.global-named",
    /// A sub can change parameters above `#30`, and its caller sees the change.
    GLOBAL_NUMBERED = "subroutines.global-numbered",
    /// Subs can be nested ten levels deep and no deeper.
    LEVEL_LIMIT = "subroutines.level-limit",
    /// A local named parameter belongs to the invocation that assigns it; the same name elsewhere is another
    /// parameter.
    LOCAL_NAMED = "subroutines.local-named",
    /// When a sub returns, its local named parameters are gone, for its caller and for its next call.
    LOCAL_NAMED_DELETED = "subroutines.local-named-deleted",
    /// A sub that begins must end with an endsub of the same number.
    MISSING_ENDSUB = "subroutines.missing-endsub",
    /// A sub can be named by a word in angle brackets; case does not matter in it.
    NAMED_O_WORDS = "subroutines.named-o-words",
    /// The body of a sub cannot contain another sub.
    NESTED_DEFINITION = "subroutines.nested-definition",
    /// A sub that ends without an expression leaves 0 in `#<_value>` and `#<_value_returned>`.
    NO_RETURN_VALUE = "subroutines.no-return-value",
    /// A sub can be named by a number; the letter may be upper or lower case.
    NUMBERED_O_WORDS = "subroutines.numbered-o-words",
    /// Parameters `#1` to `#30` are local to the sub: each call has its own.
    PARAMETERS_LOCAL = "subroutines.parameters-local",
    /// After the return `#1` to `#30` have the values that they had before the call, however many were
    /// passed.
    PARAMETERS_RESTORED = "subroutines.parameters-restored",
    /// A program end inside a sub ends the whole program.
    PROGRAM_END_IN_SUB = "subroutines.program-end-in-sub",
    /// A sub can call itself.
    RECURSION = "subroutines.recursion",
    /// A return goes back to the caller at once, as endsub does.
    RETURN = "subroutines.return",
    /// A return leaves conditions and loops too, which work again at the next call.
    RETURN_IN_CONTROL = "subroutines.return-in-control",
    /// A return in a sub must carry the number of the sub that it leaves, or any return leaves it: the
    /// documents list only the return outside any sub as an error.
    RETURN_LABEL = "subroutines.return-label",
    /// An expression after return or endsub is the sub's value: it goes to `#<_value>`, and
    /// `#<_value_returned>` becomes 1.
    RETURN_VALUE = "subroutines.return-value",
    /// An endsub outside a sub is refused.
    STRAY_ENDSUB = "subroutines.stray-endsub",
    /// A return outside a sub is refused.
    STRAY_RETURN = "subroutines.stray-return",
    /// Each sub has a name or number of its own: a second definition of it is refused.
    UNIQUE_NAME = "subroutines.unique-name",
    /// Calling a sub that neither the program nor a file defines is refused.
    UNKNOWN_SUB = "subroutines.unknown-sub",
    /// Parameters from the first one not passed up to `#30` have the caller's values inside the sub.
    UNPASSED_ARGUMENTS = "subroutines.unpassed-arguments",
    /// Both value parameters are cleared just before the next call, so the called sub finds them 0.
    VALUE_CLEARED = "subroutines.value-cleared",
    /// Until the next call the value parameters keep what the last return left.
    VALUE_KEPT = "subroutines.value-kept",
}
