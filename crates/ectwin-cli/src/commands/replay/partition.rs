//! The part of the cases that runs here: `--partition i/n`, or from the variables of a CI job.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// The value of `--partition`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PartitionChoice {
    /// This one.
    Given(Partition),
    /// The one in the variables of a CI system.
    Auto,
}

impl FromStr for PartitionChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" { Ok(Self::Auto) } else { text.parse().map(Self::Given) }
    }
}

/// One part of several, counted from 1. The cases are distributed one by one, so that the parts are similar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub(crate) struct Partition {
    number: u64,
    count: u64,
}

impl Partition {
    /// All cases.
    pub(crate) const WHOLE: Self = Self { number: 1, count: 1 };

    /// This part; none if there is no such part.
    pub(crate) fn new(number: u64, count: u64) -> Option<Self> {
        (1..=count).contains(&number).then_some(Self { number, count })
    }

    /// The number of parts.
    pub(crate) const fn count(self) -> u64 {
        self.count
    }

    /// The part of `count` that has this case, counted from 1.
    pub(crate) const fn of_case(case: u64, count: u64) -> Self {
        Self { number: case.saturating_sub(1) % count + 1, count }
    }

    /// The number of its cases, for this total number.
    pub(crate) const fn cases_of(self, cases: u64) -> u64 {
        cases / self.count + (self.number <= cases % self.count) as u64
    }

    /// Its cases of this total number, counted from 1, in order.
    pub(crate) fn cases(self, cases: u64) -> impl Iterator<Item = u64> {
        (self.number..=cases).step_by(usize::try_from(self.count).unwrap_or(usize::MAX))
    }

    /// Whether this case, counted from 1, is in it.
    pub(crate) fn has(self, case: u64) -> bool {
        Self::of_case(case, self.count) == self
    }
}

impl fmt::Display for Partition {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.number, self.count)
    }
}

impl FromStr for Partition {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text
            .split_once('/')
            .and_then(|(number, count)| Partition::new(number.parse().ok()?, count.parse().ok()?));
        numbers.ok_or_else(|| "expected a part and the number of parts such as 1/4, or `auto`".to_owned())
    }
}

impl TryFrom<String> for Partition {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Partition> for String {
    fn from(partition: Partition) -> Self {
        partition.to_string()
    }
}

/// The values of a CI system.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    /// The part for this job.
    pub(crate) partition: Partition,
    /// The file that Bazel checks to see that sharding is supported (its test encyclopedia, "Test sharding").
    pub(crate) status_file: Option<PathBuf>,
    /// What the values leave open, as a warning.
    pub(crate) doubt: Option<String>,
}

/// The variables of a CI system for the part.
struct Source {
    name: &'static str,
    /// Present in a job with several parts.
    index: &'static str,
    /// What its variables leave open.
    doubt: fn(&Variables) -> Option<String>,
    partition: fn(u64, &Variables) -> Result<Option<Partition>, String>,
}

/// Returns the value of an environment variable.
type Variables<'a> = dyn Fn(&str) -> Option<String> + 'a;

const SOURCES: &[Source] = &[
    Source {
        name: "Bazel",
        index: "TEST_SHARD_INDEX",
        doubt: |_| None,
        partition: |index, of| Ok(from_zero(index, number("TEST_TOTAL_SHARDS", of)?)),
    },
    Source {
        name: "GitLab",
        index: "CI_NODE_INDEX",
        doubt: |_| None,
        partition: |index, of| Ok(Partition::new(index, number("CI_NODE_TOTAL", of)?)),
    },
    Source { name: "Slurm", index: "SLURM_ARRAY_TASK_ID", doubt: slurm_doubt, partition: slurm },
    Source {
        name: "Kubernetes",
        index: "JOB_COMPLETION_INDEX",
        doubt: |_| None,
        partition: |index, of| Ok(from_zero(index, number(SHARDS, of)?)),
    },
];

/// The part in the environment.
///
/// # Errors
/// The mistake: there are variables of no system, or of several, or the numbers do not match.
pub(crate) fn from_environment(of: &Variables) -> Result<Shard, String> {
    let told: Vec<&Source> = SOURCES.iter().filter(|source| of(source.index).is_some()).collect();
    let source = match told[..] {
        [source] => source,
        [] => {
            let names: Vec<&str> = SOURCES.iter().map(|source| source.index).collect();
            return Err(format!("none of the variables {} is set", names.join(", ")));
        }
        [first, second, ..] => {
            return Err(format!("both {} and {} define a part", first.index, second.index));
        }
    };
    let index = number(source.index, of)?;
    let partition = (source.partition)(index, of)?.ok_or_else(|| {
        format!("the variables of {} contradict each other: {}={index}", source.name, source.index)
    })?;
    let status_file = of("TEST_SHARD_STATUS_FILE").filter(|_| source.name == "Bazel").map(PathBuf::from);
    Ok(Shard { partition, status_file, doubt: (source.doubt)(of) })
}

fn number(name: &str, of: &Variables) -> Result<u64, String> {
    let value = of(name).ok_or_else(|| format!("the variable {name} is not set"))?;
    value.parse().map_err(|_| format!("the variable {name} is `{value}`, which is not a number"))
}

fn from_zero(index: u64, count: u64) -> Option<Partition> {
    Partition::new(index.checked_add(1)?, count)
}

/// The number of parts of the whole campaign, for systems that do not know it.
const SHARDS: &str = "ECTWIN_SHARDS";

/// With the number of parts, the task n is part n, also in an array that repeats some tasks: Slurm sets minimum, maximum
/// and count of the array that runs, so that `--array=4` has one task. Without it an array may begin anywhere and have
/// steps; one with gaps cannot be mapped to parts, and neither can a single task, unless it is the first.
fn slurm(index: u64, of: &Variables) -> Result<Option<Partition>, String> {
    if of(SHARDS).is_some() {
        let shards = number(SHARDS, of)?;
        let no_part = || {
            format!(
                "the task {index} of Slurm is not one of {shards}: submit the array as --array=1-{shards}"
            )
        };
        return Partition::new(index, shards).map(Some).ok_or_else(no_part);
    }
    let (first, last) = (number("SLURM_ARRAY_TASK_MIN", of)?, number("SLURM_ARRAY_TASK_MAX", of)?);
    let count = number("SLURM_ARRAY_TASK_COUNT", of)?;
    if count == 1 && first > 1 {
        return Err(format!(
            "the job array of Slurm has only the task {index}: if it repeats a task of a larger array, set {SHARDS} to \
             the number of tasks of that array"
        ));
    }
    let step = of("SLURM_ARRAY_TASK_STEP").map_or(Ok(1), |_| number("SLURM_ARRAY_TASK_STEP", of))?.max(1);
    let place = |id: u64| id.checked_sub(first).filter(|above| above % step == 0).map(|above| above / step);
    if place(last).and_then(|places| places.checked_add(1)) != Some(count) {
        return Err(format!(
            "the job array of Slurm has gaps: submit it as --array=1-N; to repeat some of its tasks, set {SHARDS} to N"
        ));
    }
    Ok(place(index).and_then(|place| from_zero(place, count)))
}

/// What Slurm leaves open: an array that is not 1-N or 0-N may repeat some tasks of a larger one.
fn slurm_doubt(of: &Variables) -> Option<String> {
    if of(SHARDS).is_some() {
        return None;
    }
    let value = |name: &str| number(name, of).ok();
    let (first, last) = (value("SLURM_ARRAY_TASK_MIN")?, value("SLURM_ARRAY_TASK_MAX")?);
    let count = value("SLURM_ARRAY_TASK_COUNT")?;
    let is_whole = count > 1 && first <= 1 && last.checked_sub(first)?.checked_add(1)? == count;
    let doubt = || {
        format!(
            "the array of Slurm has the tasks {first} to {last}, {count} of them, and these are taken as all parts; if it \
             repeats tasks of a larger array, set {SHARDS} to the number of tasks of that array"
        )
    };
    (!is_whole).then(doubt)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(variables: &[(&str, &str)]) -> Result<String, String> {
        let of = |name: &str| {
            variables.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).to_owned())
        };
        from_environment(&of).map(|shard| shard.partition.to_string())
    }

    #[test]
    fn each_system_counts_its_way() {
        let slurm = |id, step| {
            told(&[
                ("SLURM_ARRAY_TASK_ID", id),
                ("SLURM_ARRAY_TASK_MIN", "3"),
                ("SLURM_ARRAY_TASK_MAX", "9"),
                ("SLURM_ARRAY_TASK_COUNT", if step == "2" { "4" } else { "7" }),
                ("SLURM_ARRAY_TASK_STEP", step),
            ])
        };
        assert_eq!(told(&[("TEST_SHARD_INDEX", "0"), ("TEST_TOTAL_SHARDS", "3")]).as_deref(), Ok("1/3"));
        assert_eq!(told(&[("CI_NODE_INDEX", "3"), ("CI_NODE_TOTAL", "3")]).as_deref(), Ok("3/3"));
        assert_eq!(told(&[("JOB_COMPLETION_INDEX", "4"), ("ECTWIN_SHARDS", "5")]).as_deref(), Ok("5/5"));
        assert_eq!(slurm("3", "1").as_deref(), Ok("1/7"));
        assert_eq!(slurm("9", "2").as_deref(), Ok("4/4"));
    }

    #[test]
    fn what_names_no_part_is_refused() {
        let cases: &[(&[(&str, &str)], &str)] = &[
            (&[], "none of the variables"),
            (&[("CI_NODE_INDEX", "1"), ("TEST_SHARD_INDEX", "0")], "define a part"),
            (&[("JOB_COMPLETION_INDEX", "0")], "ECTWIN_SHARDS is not set"),
            (&[("TEST_SHARD_INDEX", "3"), ("TEST_TOTAL_SHARDS", "3")], "contradict"),
            (&[("CI_NODE_INDEX", "one"), ("CI_NODE_TOTAL", "3")], "which is not a number"),
            (
                &[
                    ("SLURM_ARRAY_TASK_ID", "1"),
                    ("SLURM_ARRAY_TASK_MIN", "1"),
                    ("SLURM_ARRAY_TASK_MAX", "9"),
                    ("SLURM_ARRAY_TASK_COUNT", "3"),
                ],
                "gaps",
            ),
        ];
        for (variables, expected) in cases {
            let refused = told(variables).unwrap_err();
            assert!(refused.contains(expected), "{refused}");
        }
    }

    /// The variables of a task, as Slurm sets them for an array.
    fn slurm_task(
        id: &str,
        min: &str,
        max: &str,
        count: &str,
        step: &str,
        shards: Option<&str>,
    ) -> Result<Shard, String> {
        let of = |name: &str| {
            let value = match name {
                "SLURM_ARRAY_TASK_ID" => Some(id),
                "SLURM_ARRAY_TASK_MIN" => Some(min),
                "SLURM_ARRAY_TASK_MAX" => Some(max),
                "SLURM_ARRAY_TASK_COUNT" => Some(count),
                "SLURM_ARRAY_TASK_STEP" => Some(step),
                SHARDS => shards,
                _ => None,
            };
            value.map(str::to_owned)
        };
        from_environment(&of)
    }

    #[test]
    fn a_task_that_is_repeated_keeps_its_part_if_the_number_of_parts_is_known() {
        let part = |id, min, max, count, step| {
            let shard = slurm_task(id, min, max, count, step, Some("64"));
            shard.map(|shard| (shard.partition.to_string(), shard.doubt))
        };
        for repeated in
            [part("4", "1", "64", "64", "1"), part("4", "4", "4", "1", "1"), part("4", "4", "9", "2", "5")]
        {
            assert_eq!(repeated, Ok(("4/64".to_owned(), None)));
        }
        for wrong in [part("0", "0", "63", "64", "1"), part("65", "65", "65", "1", "1")] {
            assert!(wrong.is_err_and(|message| message.contains("submit the array as --array=1-64")));
        }
    }

    #[test]
    fn where_slurm_does_not_say_it_the_user_is_warned_or_asked() {
        let told = |id, min, max, count, step| {
            let shard = slurm_task(id, min, max, count, step, None);
            shard.map(|shard| (shard.partition.to_string(), shard.doubt.is_some()))
        };
        let taken = |part: &str, is_in_doubt| Ok((part.to_owned(), is_in_doubt));
        assert_eq!(told("4", "1", "64", "64", "1"), taken("4/64", false));
        assert_eq!(told("4", "0", "63", "64", "1"), taken("5/64", false));
        assert_eq!(told("7", "3", "7", "2", "4"), taken("2/2", true), "--array=3,7");
        assert_eq!(told("8", "0", "8", "5", "2"), taken("5/5", true), "--array=0-9:2");
        assert_eq!(told("5", "3", "9", "7", "1"), taken("3/7", true), "--array=3-9");
        assert_eq!(told("1", "1", "1", "1", "1"), taken("1/1", true), "--array=1");
        let single = told("4", "4", "4", "1", "1");
        assert!(single.is_err_and(|message| message.contains("set ECTWIN_SHARDS")), "--array=4");
        let gaps = told("7", "3", "7", "2", "1");
        assert!(
            gaps.is_err_and(|message| message.contains("has gaps")),
            "--array=3,7 of a Slurm without step"
        );
    }

    #[test]
    fn every_case_is_in_one_part() {
        for count in 1..=7 {
            for case in 1..=20 {
                let parts = (1..=count).filter_map(|number| Partition::new(number, count));
                assert_eq!(parts.filter(|part| part.has(case)).count(), 1, "case {case} of {count}");
            }
        }
        for part in (1..=7).filter_map(|number| Partition::new(number, 7)) {
            assert!(part.cases(20).eq((1..=20).filter(|&case| part.has(case))), "{part}");
            assert!(part.cases(3).eq((1..=3).filter(|&case| part.has(case))), "{part} of 3 cases");
        }
        let thirds = [1, 2, 3].map(|number| Partition::new(number, 3).map(|part| part.cases_of(8)));
        assert_eq!(thirds, [Some(3), Some(3), Some(2)]);
        for wrong in ["0/3", "4/3", "1", "1/0", "a/b"] {
            assert!(wrong.parse::<PartitionChoice>().is_err(), "{wrong}");
        }
    }
}
