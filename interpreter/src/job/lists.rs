//! From lists and their overrides to a machine that can run.

use crate::diag::{Condition, Diagnostic, Severity};
use crate::machine::{ListFiles, Machine, Override, leaves_out};
use std::fmt;

/// The lists of a machine with the settings of a user on top. Without files: the built-in machine `xyz`.
///
/// ```
/// use kontur_interpreter::job::MachineLists;
///
/// let settings = ["X.getriebe[0].kv=5000".to_owned()];
/// let lists = MachineLists { settings: &settings, cycle_us: Some(2000), ..MachineLists::default() };
/// let (machine, warnings) = lists.load().unwrap();
/// assert_eq!((machine.cycle.us(), warnings.len()), (2000, 0));
/// ```
#[derive(Clone, Copy, Default)]
pub struct MachineLists<'a> {
    /// Source of the lists, and the name of the start-up list.
    pub files: Option<(&'a dyn ListFiles, &'a str)>,
    /// `AXIS.key=value` or `channel.key=value`, in the order given.
    pub settings: &'a [String],
    /// Cycle time in microseconds that replaces the machine's.
    pub cycle_us: Option<u32>,
    /// Whether keys that are not modelled and parts that cannot be built are refused.
    pub strict: bool,
}

impl fmt::Debug for MachineLists<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MachineLists")
            .field("start_up", &self.files.map(|(_, name)| name))
            .field("settings", &self.settings)
            .field("cycle_us", &self.cycle_us)
            .field("strict", &self.strict)
            .finish()
    }
}

impl MachineLists<'_> {
    /// Whether the settings or `cycle_us` set the cycle, whatever the lists say.
    pub fn sets_cycle(&self) -> bool {
        let mut settings = self.settings.iter().filter_map(|text| Override::parse(text).ok());
        self.cycle_us.is_some() || settings.any(|setting| setting.sets_cycle())
    }

    /// The machine, and the warnings of its lists.
    ///
    /// # Errors
    /// All diagnostics, if at least one of them is an error; see [`Machine::load`] and [`Machine::chains`].
    pub fn load(&self) -> Result<(Machine, Vec<Diagnostic>), Vec<Diagnostic>> {
        let mut overrides = Vec::new();
        for setting in self.settings {
            overrides.push(Override::parse(setting).map_err(|d| vec![*d])?);
        }
        if let Some(us) = self.cycle_us {
            let text = format!("kontur.cycle_time_us={us}");
            overrides.push(Override::parse(&text).map_err(|d| vec![*d])?);
        }
        let loaded = match self.files {
            None => Machine::builtin(&overrides),
            Some((files, start_up)) => Machine::load(files, start_up, &overrides),
        };
        let (machine, mut messages) = loaded?;
        messages.extend(given_twice(self.settings));
        let refused = |d: Diagnostic, wrong: bool, hint: &str| {
            if wrong { d.severity(Severity::Error).hint(hint) } else { d }
        };
        let unknown = |d: &Diagnostic| d.id == Condition::ListKeyUnknown;
        if self.strict && messages.iter().any(unknown) {
            let hint = "--strict refuses keys that are not modelled";
            let strict = messages.into_iter().map(|d| {
                let wrong = unknown(&d);
                refused(d, wrong, hint)
            });
            return Err(strict.collect());
        }
        // a filter or controller that the list describes but that cannot be built: the axis would move without it
        let chains = machine.chains().1;
        let left_out = |d: &Diagnostic| self.strict && leaves_out(d);
        if chains.iter().any(|d| d.is_error() || left_out(d)) {
            let hint = "--strict refuses parts that cannot be built";
            let chains = chains.into_iter().map(|d| {
                let wrong = left_out(&d);
                refused(d, wrong, hint)
            });
            return Err(messages.into_iter().chain(chains).collect());
        }
        Ok((machine, messages))
    }
}

/// K-LIST-DUP for settings that a later one replaces.
fn given_twice(settings: &[String]) -> impl Iterator<Item = Diagnostic> {
    let key = |setting: &String| {
        setting.split('=').next().unwrap_or_default().trim().replace("[]", "[0]")
    };
    let keys: Vec<String> = settings.iter().map(key).collect();
    (1..keys.len()).filter_map(move |i| {
        let twice = keys[..i].iter().any(|other| other.eq_ignore_ascii_case(&keys[i]));
        let text = format!("--set {}: given twice, the last value is used", keys[i]);
        twice.then(|| Diagnostic::new(Condition::ListDuplicate, text))
    })
}
