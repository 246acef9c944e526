//! The run: the toolpath processed block by block, and the program's blocks statement by statement.

use crate::ids::choice;
use gaugeblock_vocabulary::{
    BlockLocation, End, Fault, Language, Outcome, Program as Files, Scenario, Settings, Step,
};

use super::record::{Record, TOOLPATH};
use super::refusal::{Refusal, StepError};
use super::syntax::{self, Action, Condition, Program, Statement};
use super::toolpath::{self, Processed};
use super::variables::Variables;
use crate::Choices;
use crate::RuleCoverage;

/// A program that runs.
pub(super) struct Run<'a> {
    pub(super) program: &'a Program,
    pub(super) choices: Choices,
    pub(super) coverage: &'a mut RuleCoverage,
    pub(super) variables: Variables,
    pub(super) record: Record,
    /// The newline procedure runs before the next thing that is printed.
    pub(super) newline_waits: bool,
    /// Where a fault would be: the statement or line in progress.
    at: BlockLocation,
}

/// What the documents say about a scenario in this language, and the rules that were reached.
pub fn run(scenario: &Scenario) -> (Outcome, RuleCoverage) {
    let mut coverage = RuleCoverage::default();
    let choices = Choices::known(&scenario.options);
    let toolpath = scenario.program.files.get(TOOLPATH).map_or("", String::as_str);
    let (steps, end) = match compiled(scenario, toolpath, &choices, &mut coverage) {
        Ok((program, blocks)) => {
            let mut run = Run {
                variables: program.variables.clone(),
                program: &program,
                choices,
                coverage: &mut coverage,
                record: Record::new(scenario.budget),
                newline_waits: false,
                at: BlockLocation::new(Files::MAIN, 1),
            };
            let stopped = run.whole(&blocks).err();
            let end = stopped.map_or(End::ProgramEnd, |error| ended(error, run.at, run.coverage));
            (run.record.steps, end)
        }
        Err((at, error)) => (Vec::new(), ended(error, at, &mut coverage)),
    };
    (outcome(steps, end), coverage)
}

fn compiled(
    scenario: &Scenario,
    toolpath: &str,
    choices: &Choices,
    coverage: &mut RuleCoverage,
) -> Result<(Program, Vec<Processed>), (BlockLocation, StepError)> {
    let of = |file: &'static str| move |(line, error)| (BlockLocation::new(file, line), error);
    let toolpath = toolpath::read(toolpath, choices).map_err(of(TOOLPATH))?;
    let main = &scenario.program.main;
    let program = syntax::read(main, toolpath.variables, choices.clone(), coverage);
    Ok((program.map_err(of(Files::MAIN))?, toolpath.blocks))
}

fn ended(error: StepError, at: BlockLocation, coverage: &mut RuleCoverage) -> End {
    match error {
        StepError::Refused(Refusal { rule, kind, message }) => {
            if let Some(rule) = rule {
                coverage.refused(rule);
            }
            End::Fault(Fault { kind: Some(kind), block: Some(at), span: None, message })
        }
        StepError::Unspecified(why) => End::Unspecified { block: at, why },
        StepError::Exhausted(bound) => End::BudgetExhausted { bound },
    }
}

fn outcome(steps: Vec<Step>, end: End) -> Outcome {
    Outcome {
        language: Language::Gpp,
        start: Settings::default(),
        steps,
        end,
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    }
}

impl Run<'_> {
    fn whole(&mut self, blocks: &[Processed]) -> Result<(), StepError> {
        for (line, text) in &self.program.warnings {
            self.record.warn(*line, text)?;
        }
        for block in blocks {
            self.processed(block)?;
        }
        if std::mem::take(&mut self.newline_waits) {
            self.procedure()?;
        }
        Ok(())
    }

    /// A block of the toolpath sets its variables, and then the program's block of that name is executed.
    fn processed(&mut self, block: &Processed) -> Result<(), StepError> {
        self.at = BlockLocation::new(TOOLPATH, block.line);
        self.record.begin()?;
        self.leave_out(&block.values);
        for (variable, value) in &block.values {
            self.receive(*variable, value.clone())?;
        }
        self.record.end(
            self.at.clone(),
            &self.variables,
            self.choices.get::<choice::gpp::Tie>(),
        )?;
        let program = self.program;
        program.blocks.get(&block.heading).map_or(Ok(()), |block| self.statements(block))
    }

    pub(super) fn procedure(&mut self) -> Result<(), StepError> {
        let program = self.program;
        self.statements(&program.procedure)
    }

    fn statements(&mut self, statements: &[Statement]) -> Result<(), StepError> {
        statements.iter().try_for_each(|statement| self.statement(statement))
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), StepError> {
        let line = statement.line;
        if let Action::Repeat { body, line, until } = &statement.action {
            return self.repeat(body, *line, until);
        }
        self.begin_step(line)?;
        match &statement.action {
            Action::Assign(to, side) => {
                let cell = self.cell(to)?;
                let value = self.value(side)?;
                self.assign(to.variable, cell, value)?;
                self.end_step(line)
            }
            Action::Print(printer, items) => self.print(line, *printer, items),
            Action::Switch(on, targets) => {
                targets.iter().try_for_each(|target| self.switch(target, *on))?;
                self.end_step(line)
            }
            Action::If { condition, then, otherwise } => {
                self.conditional(line, condition, (then, otherwise))
            }
            Action::Repeat { .. } => Ok(()),
        }
    }

    fn conditional(
        &mut self,
        line: u32,
        condition: &Condition,
        (then, otherwise): (&[Statement], &[Statement]),
    ) -> Result<(), StepError> {
        let holds = self.condition(condition)?;
        self.end_step(line)?;
        self.statements(if holds { then } else { otherwise })
    }

    fn repeat(
        &mut self,
        body: &[Statement],
        line: u32,
        until: &[syntax::Test],
    ) -> Result<(), StepError> {
        loop {
            self.statements(body)?;
            self.begin_step(line)?;
            let holds = self.tests(until)?;
            self.end_step(line)?;
            if holds {
                return Ok(());
            }
        }
    }

    /// The statement at a line begins, or goes on.
    pub(super) fn begin_step(&mut self, line: u32) -> Result<(), StepError> {
        self.at = BlockLocation::new(Files::MAIN, line);
        self.record.begin()
    }

    /// The statement at a line has done what it does, up to here.
    pub(super) fn end_step(&mut self, line: u32) -> Result<(), StepError> {
        let block = BlockLocation::new(Files::MAIN, line);
        self.record.end(block, &self.variables, self.choices.get::<choice::gpp::Tie>())
    }
}
