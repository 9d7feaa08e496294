//! The CPU Units of a line in time: a step costs what the tasks that are due cost, however many others there are.

use time::{Deadlines, Instant};

use crate::cpu_unit::CpuUnit;

/// What has a periodic task: a CPU Unit, or a CPU Unit and what belongs to it.
pub trait PeriodicTask {
    /// When the next task period begins.
    fn deadline(&self) -> Instant;
}

impl PeriodicTask for CpuUnit {
    fn deadline(&self) -> Instant {
        self.deadline()
    }
}

/// One CPU Unit for each unit, in the order of the line.
#[derive(Debug)]
pub struct CpuUnits<C = CpuUnit> {
    units: Vec<C>,
    /// When each begins its next task period.
    deadlines: Deadlines,
    /// The one that was lent last: its deadline may have changed.
    lent: Option<usize>,
}

impl<C: PeriodicTask> CpuUnits<C> {
    /// These CPU Units, the one of the unit next to the master first.
    #[must_use]
    pub fn new(units: Vec<C>) -> Self {
        let mut cpus = Self { deadlines: Deadlines::new(units.len()), units, lent: None };
        cpus.each(|_, _| ());
        cpus
    }

    /// Number of CPU Units.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.units.len()
    }

    /// Whether there are none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.units.is_empty()
    }

    /// The CPU Unit at a position, counted from the master; none beyond the line.
    #[must_use]
    pub fn get(&self, position: usize) -> Option<&C> {
        self.units.get(position)
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &C> {
        self.units.iter()
    }

    /// The CPU Unit at a position, for changes, of its deadline too; none beyond the line.
    pub fn get_mut(&mut self, position: usize) -> Option<&mut C> {
        self.settle();
        let unit = self.units.get_mut(position)?;
        self.lent = Some(position);
        self.deadlines.set(position, Instant::NEVER);
        Some(unit)
    }

    /// Does something to all of them.
    pub fn each(&mut self, mut order: impl FnMut(usize, &mut C)) {
        self.lent = None;
        for (position, cpu) in self.units.iter_mut().enumerate() {
            order(position, cpu);
            self.deadlines.set(position, cpu.deadline());
        }
    }

    /// Lets each whose task is due at `now` run it by `run`, which calls [`CpuUnit::cycle`]. The others are not
    /// looked at.
    pub fn cycle(&mut self, now: Instant, mut run: impl FnMut(usize, &mut C)) {
        self.settle();
        let mut from = 0;
        while let Some(position) = self.deadlines.next_due(from, now) {
            from = position + 1;
            let Some(cpu) = self.units.get_mut(position) else { continue };
            run(position, cpu);
            self.deadlines.set(position, cpu.deadline());
        }
    }

    /// The time of the next task; [`Instant::NEVER`] without any.
    #[must_use]
    pub fn deadline(&self) -> Instant {
        let lent = self.lent.and_then(|position| self.units.get(position));
        lent.map_or(Instant::NEVER, C::deadline).min(self.deadlines.first())
    }

    fn settle(&mut self) {
        if let Some(position) = self.lent.take()
            && let Some(cpu) = self.units.get(position)
        {
            self.deadlines.set(position, cpu.deadline());
        }
    }
}

#[cfg(test)]
mod tests {
    use time::Duration;

    use super::*;

    /// A task of this period, whose next period begins then.
    struct Task {
        period: Duration,
        next: Instant,
    }

    impl PeriodicTask for Task {
        fn deadline(&self) -> Instant {
            self.next
        }
    }

    const fn after(millis: u64) -> Instant {
        Instant::from_nanos(millis * 1_000_000)
    }

    fn tasks(periods_ms: [u64; 2]) -> CpuUnits<Task> {
        let task = |millis| Task { period: Duration::from_millis(millis), next: Instant::ZERO };
        CpuUnits::new(periods_ms.map(task).into())
    }

    /// Runs the tasks that are due, and returns the positions of their CPU Units.
    fn run(cpus: &mut CpuUnits<Task>, now: Instant) -> Vec<usize> {
        let mut ran = Vec::new();
        cpus.cycle(now, |position, task| {
            task.next += task.period;
            ran.push(position);
        });
        ran
    }

    #[test]
    fn only_tasks_that_are_due_run() {
        let mut cpus = tasks([2, 4]);
        let ran = [0, 1, 2, 4].map(|millis| run(&mut cpus, after(millis)));
        assert_eq!(ran, [vec![0, 1], vec![], vec![0], vec![0, 1]]);
        assert_eq!(cpus.deadline(), after(6));
    }

    #[test]
    fn a_cpu_unit_that_was_lent_runs_at_its_new_time() {
        let mut cpus = tasks([4, 4]);
        run(&mut cpus, Instant::ZERO);
        cpus.get_mut(1).expect("the second CPU Unit").next = after(1);
        assert_eq!(cpus.deadline(), after(1));
        assert_eq!(run(&mut cpus, after(1)), [1]);
        cpus.get_mut(1).expect("the second CPU Unit").next = after(2);
        cpus.get_mut(0).expect("the first CPU Unit").next = after(3);
        assert_eq!(cpus.deadline(), after(2));
        assert_eq!(run(&mut cpus, after(3)), [0, 1]);
        cpus.get_mut(1).expect("the second CPU Unit").next = after(9);
        assert_eq!(cpus.deadline(), after(7), "the earlier time of the lent one counts no more");
        assert!(cpus.get_mut(2).is_none());
    }
}
