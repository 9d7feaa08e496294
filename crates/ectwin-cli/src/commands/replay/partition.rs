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
}

/// The variables of a CI system for the part.
struct Source {
    name: &'static str,
    /// Present in a job with several parts.
    index: &'static str,
    partition: fn(u64, &Variables) -> Result<Option<Partition>, String>,
}

/// Returns the value of an environment variable.
type Variables<'a> = dyn Fn(&str) -> Option<String> + 'a;

const SOURCES: &[Source] = &[
    Source {
        name: "Bazel",
        index: "TEST_SHARD_INDEX",
        partition: |index, of| Ok(from_zero(index, number("TEST_TOTAL_SHARDS", of)?)),
    },
    Source {
        name: "GitLab",
        index: "CI_NODE_INDEX",
        partition: |index, of| Ok(Partition::new(index, number("CI_NODE_TOTAL", of)?)),
    },
    Source { name: "Slurm", index: "SLURM_ARRAY_TASK_ID", partition: slurm },
    Source {
        name: "Kubernetes",
        index: "JOB_COMPLETION_INDEX",
        partition: |index, of| Ok(from_zero(index, number("ECTWIN_SHARDS", of)?)),
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
    Ok(Shard { partition, status_file })
}

fn number(name: &str, of: &Variables) -> Result<u64, String> {
    let value = of(name).ok_or_else(|| format!("the variable {name} is not set"))?;
    value.parse().map_err(|_| format!("the variable {name} is `{value}`, which is not a number"))
}

fn from_zero(index: u64, count: u64) -> Option<Partition> {
    Partition::new(index.checked_add(1)?, count)
}

/// An array may begin anywhere and have steps; one with gaps cannot be mapped to parts.
fn slurm(index: u64, of: &Variables) -> Result<Option<Partition>, String> {
    let (first, last) = (number("SLURM_ARRAY_TASK_MIN", of)?, number("SLURM_ARRAY_TASK_MAX", of)?);
    let count = number("SLURM_ARRAY_TASK_COUNT", of)?;
    let step = of("SLURM_ARRAY_TASK_STEP").map_or(Ok(1), |_| number("SLURM_ARRAY_TASK_STEP", of))?.max(1);
    let place = |id: u64| id.checked_sub(first).filter(|above| above % step == 0).map(|above| above / step);
    if place(last).and_then(|places| places.checked_add(1)) != Some(count) {
        return Err("the job array of Slurm has gaps: submit it as --array=1-N".to_owned());
    }
    Ok(place(index).and_then(|place| from_zero(place, count)))
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
