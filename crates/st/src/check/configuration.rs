//! Which PROGRAMs run, and when: according to a CONFIGURATION, or all of them in each scan.

use std::collections::{HashMap, HashSet};

use super::constants::Constants;
use super::scope::{Scope, key};
use super::unknown_names::nearest;
use super::{Checker, Origin, Pending};
use crate::SOURCE_BYTES_MAX;
use crate::code::Task;
use crate::problem::{Problem, Span};
use crate::syntax::ast::{
    Configuration, Expression, File, Name, Pou, PouKind, ProgramInstance, TaskDeclaration,
};
use crate::task_period::{TASK_PERIODS, is_task_period};

/// A PRIORITY that is left out is the lowest.
const PRIORITY_LAST: i128 = i128::MAX;

/// The shortest task period of a CPU Unit.
const INTERVAL_MIN_NS: u64 = 125_000;

/// Maximum text of all instances of PROGRAMs together: each instance has code of its own, so that a long PROGRAM with
/// many instances would fill any memory.
const INSTANCES_BYTES_MAX: usize = 8 * SOURCE_BYTES_MAX;

/// A task of a CONFIGURATION.
struct Planned<'t> {
    name: &'t Name,
    /// Its period, and the position of that in the source; none: it runs in each scan.
    interval: Option<(u64, Span)>,
    priority: i128,
    programs: Vec<u32>,
}

/// What a CONFIGURATION runs, and what it can name: each is found by its name in capitals.
struct Plan<'t, 'p> {
    programs: &'p [&'t Pou],
    program_names: HashMap<String, &'t Pou>,
    tasks: Vec<Planned<'t>>,
    task_places: HashMap<String, usize>,
    /// PROGRAMs without a task.
    free: Vec<u32>,
    /// The text of the instances so far.
    text_bytes: usize,
}

impl<'t, 'p> Plan<'t, 'p> {
    fn of(programs: &'p [&'t Pou]) -> Self {
        let mut program_names = HashMap::new();
        for pou in programs {
            program_names.entry(key(&pou.name.text)).or_insert(*pou);
        }
        Self {
            programs,
            program_names,
            tasks: Vec::new(),
            task_places: HashMap::new(),
            free: Vec::new(),
            text_bytes: 0,
        }
    }

    /// Whether its instances have too much text; the rest is not checked.
    const fn is_full(&self) -> bool {
        self.text_bytes > INSTANCES_BYTES_MAX
    }

    fn add_task(&mut self, task: Planned<'t>) {
        self.task_places.insert(key(&task.name.text), self.tasks.len());
        self.tasks.push(task);
    }
}

impl<'t> Checker<'t> {
    /// Stores the PROGRAMs of a file, including those that do not run.
    pub(super) fn programs(&mut self, file: &'t File) {
        let programs: Vec<&'t Pou> = file.units.iter().filter(|pou| pou.kind == PouKind::Program).collect();
        let Some((configuration, others)) = file.configurations.split_first() else {
            let programs = programs.into_iter().map(|pou| self.program(pou, &pou.name)).collect();
            self.out.tasks.push(Task { every: 1, programs });
            return;
        };
        if let Some(second) = others.first() {
            let problem = Problem::new(second.span, "a second CONFIGURATION");
            self.refuse::<()>(problem.help("a CPU Unit has one: put its tasks into the first"));
        }
        self.configure(configuration, &programs);
        let run: HashSet<String> = configuration.programs.iter().map(|own| key(&own.program.text)).collect();
        for pou in programs.into_iter().filter(|pou| !run.contains(&key(&pou.name.text))) {
            self.program(pou, &pou.name);
        }
    }

    /// A PROGRAM under its own name.
    fn program(&mut self, pou: &'t Pou, name: &Name) -> u32 {
        let scope = self.program_scope(pou, &name.text);
        let unit = self.new_unit();
        self.pending.push(Pending { pou, unit, scope, origin: Origin::User });
        unit
    }

    fn configure(&mut self, configuration: &'t Configuration, programs: &[&'t Pou]) {
        let mut plan = Plan::of(programs);
        for declaration in &configuration.tasks {
            if plan.task_places.contains_key(&key(&declaration.name.text)) {
                self.refuse_second(&declaration.name);
            } else {
                plan.add_task(self.task(declaration));
            }
        }
        let mut instances = HashSet::new();
        for instance in &configuration.programs {
            if self.is_given_up() || plan.is_full() {
                return;
            }
            if instances.insert(key(&instance.name.text)) {
                self.program_of_configuration(instance, &mut plan);
            } else {
                self.refuse_second(&instance.name);
            }
        }
        if configuration.programs.is_empty() {
            let problem = Problem::new(configuration.span, "this CONFIGURATION runs no PROGRAM");
            self.refuse::<()>(problem.help("write PROGRAM name WITH task : program;"));
        }
        self.order(plan.tasks, plan.free);
    }

    fn task(&mut self, declaration: &'t TaskDeclaration) -> Planned<'t> {
        let scope = Scope::default();
        let priority = declaration.priority.as_ref().and_then(|priority| self.priority(priority, &scope));
        let priority = priority.unwrap_or(PRIORITY_LAST);
        let interval = declaration.interval.as_ref().and_then(|interval| self.interval(interval, &scope));
        Planned { name: &declaration.name, interval, priority, programs: Vec::new() }
    }

    /// The priority, a UINT.
    fn priority(&mut self, priority: &'t Expression, scope: &Scope) -> Option<i128> {
        let number = self.constant_integer(priority, scope)?;
        if u16::try_from(number).is_ok() {
            return Some(number);
        }
        self.refuse(Problem::new(priority.span, "a PRIORITY is 0 to 65535, and 0 is the highest"))
    }

    /// The length of a period. If it is wrong, this has been reported, and the task is known nevertheless.
    fn interval(&mut self, interval: &'t Expression, scope: &Scope) -> Option<(u64, Span)> {
        let duration_ns = Constants::new(self, scope).duration(interval)?;
        match u64::try_from(duration_ns) {
            Ok(interval_ns) if interval_ns >= INTERVAL_MIN_NS => Some((interval_ns, interval.span)),
            _ => self.refuse_period(interval.span),
        }
    }

    fn refuse_period<T>(&mut self, span: Span) -> Option<T> {
        let problem = Problem::new(span, "no CPU Unit has this task period");
        self.refuse(problem.help(format!("the shortest INTERVAL is {TASK_PERIODS}")))
    }

    fn program_of_configuration(
        &mut self,
        instance: &'t ProgramInstance,
        plan: &mut Plan<'t, '_>,
    ) -> Option<()> {
        let Some(pou) = plan.program_names.get(&key(&instance.program.text)).copied() else {
            return self.unknown("PROGRAM", &instance.program, plan.programs.iter().map(|pou| &pou.name));
        };
        plan.text_bytes += (pou.span.end - pou.span.start) as usize;
        if plan.is_full() {
            return self.refuse_size(instance, plan.text_bytes);
        }
        let unit = self.program(pou, &instance.name);
        match &instance.task {
            None => plan.free.push(unit),
            Some(name) => match plan.task_places.get(&key(&name.text)) {
                Some(place) => plan.tasks[*place].programs.push(unit),
                None => return self.unknown("TASK", name, plan.tasks.iter().map(|task| task.name)),
            },
        }
        Some(())
    }

    fn refuse_size(&mut self, instance: &ProgramInstance, bytes: usize) -> Option<()> {
        let message = format!(
            "up to here, the instances of PROGRAMs have {bytes} bytes of text together, {INSTANCES_BYTES_MAX} are the most"
        );
        let help = "move code to a FUNCTION_BLOCK, whose instances share it, or remove instances";
        self.refuse(Problem::new(instance.name.span, message).help(help))
    }

    fn unknown<'n>(&mut self, what: &str, name: &Name, known: impl Iterator<Item = &'n Name>) -> Option<()> {
        let problem = Problem::new(name.span, format!("there is no {what} `{}`", name.text));
        self.refuse(match nearest(&name.text, known.map(|known| known.text.clone())) {
            Some(near) => problem.did_you_mean(near),
            None => problem,
        })
    }

    /// In the order of their priorities, within one priority in the order of declaration; programs without a
    /// task come last. A scan is as long as the shortest INTERVAL, and every other one is a multiple of it.
    fn order(&mut self, mut tasks: Vec<Planned<'t>>, free: Vec<u32>) {
        tasks.retain(|task| !task.programs.is_empty());
        tasks.sort_by_key(|task| task.priority);
        let shortest =
            tasks.iter().filter_map(|task| task.interval).min_by_key(|(interval_ns, _)| *interval_ns);
        if let Some((interval_ns, span)) = shortest
            && !is_task_period(interval_ns)
        {
            self.refuse_period::<()>(span);
        }
        let shortest = shortest.map(|(interval_ns, _)| interval_ns);
        for Planned { interval, programs, .. } in tasks {
            let (interval_ns, span) = interval.unwrap_or_default();
            let every = interval_ns.checked_div(shortest.unwrap_or(0)).unwrap_or(1).max(1);
            if interval_ns > 0 && every.checked_mul(shortest.unwrap_or(0)) != Some(interval_ns) {
                let message = "this INTERVAL is not a multiple of the shortest one";
                self.refuse::<()>(Problem::new(span, message));
            }
            self.out.tasks.push(Task { every, programs });
        }
        self.out.tasks.push(Task { every: 1, programs: free });
        self.out.period_ns = shortest;
    }
}
