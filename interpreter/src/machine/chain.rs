//! From the start-up list to settled parameters: defaults, default list, specific list, overrides, range checks.

use super::channel::couplings::default_couplings;
use super::kind::{AxisKind, kind_of, logical_number};
use super::lists::{self, Found, List, ListFiles};
use super::overrides::Override;
use super::parameters::Parameters;
use super::plausible;
use super::settled::{AxisList, Settled};
use super::table::param::{Param, Text, whole};
use super::table::{ListKind, own, start_up as stup};
use super::{Machine, hints, inert, link};
use crate::diag::{AxisRef, Condition, Diagnostic, Location, Severity};
use kontur_filters::time::CycleTime;

/// Separators of the folders in a path, on either system.
pub(super) const SEPARATORS: [char; 2] = ['/', '\\'];
/// Hint for a list that exists but cannot be read.
const UNREADABLE: &str = "a list must be a readable text file in UTF-8 or Latin-1";
/// Name of kontur's list, next to the start-up list.
pub(super) const OWN_LIST: &str = "kontur.lis";

impl Machine {
    /// Loads a machine from its start-up list and applies overrides. Returns the machine with all warnings.
    ///
    /// # Errors
    /// All diagnostics, if at least one of them is an error: K-0153 a list that cannot be read, K-0031 numbers that do
    /// not fit together, K-0070 a refused value, K-0073 an override that names nothing, 110076, 110268, 110270, 110472, 120178.
    pub fn load(
        files: &dyn ListFiles,
        start_up: &str,
        overrides: &[Override],
    ) -> Result<(Self, Vec<Diagnostic>), Vec<Diagnostic>> {
        let mut chain = Chain { files, start_up, diagnostics: Vec::new() };
        let machine = chain.run(overrides);
        let diagnostics = chain.diagnostics;
        match machine {
            Some(machine) if !diagnostics.iter().any(Diagnostic::is_error) => {
                Ok((machine, diagnostics))
            }
            _ => Err(diagnostics),
        }
    }
}

/// The path of a list named in a start-up list: relative to its folder, either slash.
pub(super) fn beside(start_up: &str, named: &str) -> String {
    let named = named.replace('\\', "/");
    let absolute = named.starts_with('/') || named.as_bytes().get(1) == Some(&b':');
    if let (Some((folder, _)), false, true) =
        (start_up.rsplit_once('\\'), absolute, start_up.starts_with(VERBATIM))
    {
        return verbatim(folder, &named);
    }
    match start_up.rsplit_once(SEPARATORS) {
        Some((folder, _)) if !absolute => {
            format!("{folder}/{}", named.strip_prefix("./").unwrap_or(&named))
        }
        _ => named,
    }
}

/// K-0153.
fn unreadable(path: &str, reason: &str, hint: &str) -> Diagnostic {
    let text = format!("list `{path}` cannot be read: {reason}");
    Diagnostic::new(Condition::NoList, text).hint(hint)
}

/// Prefix of a path that Windows does not interpret: with backslashes only, and without `.` and `..`. Programs that
/// resolve paths return such ones.
const VERBATIM: &str = r"\\?\";

fn verbatim(folder: &str, named: &str) -> String {
    let mut parts: Vec<&str> = folder.split('\\').collect();
    for part in named.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("\\")
}

struct Chain<'a> {
    files: &'a dyn ListFiles,
    start_up: &'a str,
    diagnostics: Vec<Diagnostic>,
}

impl Chain<'_> {
    fn run(&mut self, overrides: &[Override]) -> Option<Machine> {
        let mut settled = self.read_all(overrides)?;
        let names = link::names(&settled, &mut self.diagnostics);
        self.override_all(&mut settled, &names, overrides);
        let cycle = self.check_all(&mut settled, &names);
        let folder = self.start_up.rsplit_once(SEPARATORS).map_or("", |(folder, _)| folder);
        let name =
            folder.rsplit(SEPARATORS).find(|n| !n.is_empty() && *n != ".").unwrap_or("machine");
        let machine = link::machine(name, cycle, settled, &names, &mut self.diagnostics)?;
        hints::check(&machine, &mut self.diagnostics);
        Some(machine)
    }

    fn path(&self, named: &str) -> String {
        beside(self.start_up, named)
    }

    /// Reads a list that must exist; `at` is the place that names it.
    fn read(&mut self, kind: ListKind, path: &str, at: Option<Location>) -> Option<List> {
        let (reason, hint) = match lists::find(self.files, path) {
            Ok(Some(found)) => return Some(self.list(kind, path, &found, at)),
            Ok(None) if at.is_some() => (
                "file not found".to_owned(),
                "names are relative to the folder of the start-up list",
            ),
            Ok(None) => (
                "file not found".to_owned(),
                "-m takes a folder with a start-up list, the list itself or a TwinCAT project",
            ),
            Err(reason) => (reason, UNREADABLE),
        };
        let mut diagnostic = unreadable(path, &reason, hint);
        diagnostic.source = at;
        self.diagnostics.push(diagnostic);
        None
    }

    /// The list in a file, with a note if the case of its name differs, because not every file system finds it then.
    fn list(&mut self, kind: ListKind, path: &str, found: &Found, at: Option<Location>) -> List {
        let Some(other) = &found.other_case else {
            return lists::read(kind, path, &found.bytes, &mut self.diagnostics);
        };
        let last = |path: &str| path.rsplit(SEPARATORS).next().unwrap_or_default().to_owned();
        let text = format!(
            "{} is {}: upper and lower case differ from the file name",
            last(path),
            last(other)
        );
        let mut note = Diagnostic::new(Condition::Odd, text).severity(Severity::Note);
        note.source = at;
        self.diagnostics.push(note.hint("write the name as it is on disk: case-sensitive file systems do not find it under this name"));
        lists::read(kind, other, &found.bytes, &mut self.diagnostics)
    }

    /// Reads the list that a text entry of the start-up list names; an absent entry is not an error.
    fn read_named(
        &mut self,
        start_up: &Parameters,
        kind: ListKind,
        param: Param<Text>,
    ) -> Option<List> {
        let setting = start_up.set_by(param)?;
        let named = setting.value.text().filter(|name| !name.is_empty())?;
        self.read(kind, &self.path(named), setting.at.clone())
    }

    /// The start-up list; `None` if there is none that can be read.
    fn start_up_list(&mut self, overrides: &[Override]) -> Option<Parameters> {
        let mut start_up = Parameters::new(ListKind::StartUp);
        start_up.apply(&self.read(ListKind::StartUp, self.start_up, None)?);
        self.override_list(&mut start_up, "start_up", overrides);
        if start_up.get(stup::LIST_FORMAT).as_deref() == Some("BINAER") {
            let message = "listen: binary lists are not read, export the lists as ASCII";
            self.diagnostics.push(
                Diagnostic::new(Condition::Unsupported, message).parameter(stup::LIST_FORMAT),
            );
            return None;
        }
        if start_up.get(stup::CHANNEL_COUNT).is_some_and(|n| n > 1.0) {
            let message = "kanal_anzahl: one channel is simulated, that of sda_mds[0]";
            let mut diagnostic = Diagnostic::new(Condition::Unsupported, message)
                .severity(Severity::Warning)
                .parameter(stup::CHANNEL_COUNT);
            diagnostic.source = start_up.set_by(stup::CHANNEL_COUNT).and_then(|s| s.at.clone());
            self.diagnostics.push(diagnostic);
        }
        Some(start_up)
    }

    /// The list of the channel over its defaults.
    fn channel_lists(&mut self, start_up: &Parameters, overrides: &[Override]) -> Parameters {
        let mut channel = Parameters::new(ListKind::Channel);
        for param in [stup::CHANNEL_DEFAULTS, stup::CHANNEL_LIST] {
            if let Some(list) = self.read_named(start_up, ListKind::Channel, param) {
                channel.apply(&list);
            }
        }
        if start_up.set_by(stup::CHANNEL_LIST).is_none() {
            let message = format!(
                "{}: the start-up list does not name a channel list (sda_mds[0])",
                self.start_up
            );
            self.diagnostics
                .push(Diagnostic::new(Condition::ListLink, message).parameter(stup::CHANNEL_LIST));
        }
        self.override_list(&mut channel, "channel", overrides);
        channel
    }

    /// `kontur.lis`, if there is one.
    fn own_list(&mut self, overrides: &[Override]) -> Parameters {
        let mut own = Parameters::new(ListKind::Kontur);
        let path = self.path(OWN_LIST);
        match lists::find(self.files, &path) {
            Ok(None) => {}
            Ok(Some(found)) => own.apply(&self.list(ListKind::Kontur, &path, &found, None)),
            Err(reason) => {
                self.diagnostics.push(unreadable(&path, &reason, UNREADABLE));
            }
        }
        self.override_list(&mut own, "kontur", overrides);
        own
    }

    fn read_all(&mut self, overrides: &[Override]) -> Option<Settled> {
        let start_up = self.start_up_list(overrides)?;
        let channel = self.channel_lists(&start_up, overrides);
        let defaults = self.read_named(&start_up, ListKind::Axis, stup::AXIS_DEFAULTS);
        let mut axes = Vec::new();
        for file in self.axis_files(&start_up) {
            let Some(list) = self.read_named(&start_up, ListKind::Axis, file) else { continue };
            let mut parameters = Parameters::new(ListKind::Axis);
            if let Some(defaults) = &defaults {
                parameters.apply(defaults);
            }
            parameters.apply(&list);
            let named = start_up.get(file).unwrap_or_default();
            axes.push(AxisList { file: self.path(&named), parameters });
        }
        let own = self.own_list(overrides);
        let tools = self.data(&start_up, ListKind::Tool, stup::TOOL_LIST, ("tool", overrides));
        let zero = self.data(&start_up, ListKind::Zero, stup::ZERO_LIST, ("zero", overrides));
        let named = [stup::EXTERNAL_LIST, stup::OLD_EXTERNAL_LIST]
            .into_iter()
            .find(|list| start_up.get(*list).is_some_and(|name| !name.is_empty()));
        let named = named.unwrap_or(stup::EXTERNAL_LIST);
        let external = self.data(&start_up, ListKind::External, named, ("external", overrides));
        Some(Settled { start_up, channel, axes, own, tools, zero, external })
    }

    /// A list of channel data, which may be absent, with the changes made by `--set`.
    fn data(
        &mut self,
        start_up: &Parameters,
        kind: ListKind,
        named: Param<Text>,
        (target, overrides): (&str, &[Override]),
    ) -> Parameters {
        let mut data = Parameters::new(kind);
        if let Some(list) = self.read_named(start_up, kind, named) {
            data.apply(&list);
        }
        self.override_list(&mut data, target, overrides);
        data
    }

    /// Keys of the axis lists in ascending order, at most P-STUP-00014.
    fn axis_files(&mut self, start_up: &Parameters) -> Vec<Param<Text>> {
        let mut files: Vec<Param<Text>> = (0..32)
            .map(|i| stup::AXIS_LIST.at(i))
            .filter(|file| start_up.set_by(*file).is_some())
            .collect();
        let limit = start_up.get(stup::AXIS_LIST_COUNT).unwrap_or(f64::INFINITY);
        let more: Vec<Param<Text>> = (files.len() as f64 > limit)
            .then(|| files.drain(files.len().min(whole(limit).unwrap_or(0) as usize)..))
            .into_iter()
            .flatten()
            .collect();
        for file in more {
            let message =
                format!("{}: more axis lists than zahl_mds = {limit}, ignored", file.place());
            let mut diagnostic =
                Diagnostic::new(Condition::ListCount, message).parameter(stup::AXIS_LIST_COUNT);
            diagnostic.source = start_up.set_by(file).and_then(|s| s.at.clone());
            self.diagnostics.push(diagnostic);
        }
        files
    }

    fn override_list(&mut self, parameters: &mut Parameters, target: &str, overrides: &[Override]) {
        for wanted in overrides.iter().filter(|o| o.target().eq_ignore_ascii_case(target)) {
            match wanted.apply(parameters) {
                Ok(()) => self.diagnostics.extend(wanted.empty_index()),
                Err(diagnostic) => self.diagnostics.push(*diagnostic),
            }
        }
    }

    fn override_all(&mut self, settled: &mut Settled, names: &link::Names, overrides: &[Override]) {
        for wanted in overrides {
            if ["start_up", "channel", "kontur", "tool", "zero", "external"]
                .iter()
                .any(|t| wanted.target().eq_ignore_ascii_case(t))
            {
                continue;
            }
            for target in wanted.target().split(',').map(str::trim) {
                let number = names.number(target);
                if number.is_none() && target != Override::EVERY_AXIS {
                    self.diagnostics.push(wanted.unknown_target(target, &names.all()));
                    continue;
                }
                let is_meant = |axis: &Parameters| match number {
                    Some(number) => logical_number(axis) == number,
                    None => kind_of(axis) != AxisKind::Spindle,
                };
                let mut meant = settled.axes.iter_mut().filter(|a| is_meant(&a.parameters));
                if let Some(diagnostic) =
                    meant.find_map(|axis| wanted.apply(&mut axis.parameters).err())
                {
                    self.diagnostics.push(*diagnostic);
                    break;
                }
            }
            self.diagnostics.extend(wanted.empty_index());
        }
    }

    fn check_all(&mut self, settled: &mut Settled, names: &link::Names) -> CycleTime {
        let diagnostics = &mut self.diagnostics;
        // the cycle first: it limits delay times
        plausible::check(&mut settled.own, CycleTime::DEFAULT, None, diagnostics);
        let cycle =
            CycleTime::from_us(settled.own.get(own::CYCLE_TIME)).unwrap_or(CycleTime::DEFAULT);
        plausible::check(&mut settled.start_up, cycle, None, diagnostics);
        plausible::check(&mut settled.channel, cycle, None, diagnostics);
        plausible::check(&mut settled.tools, cycle, None, diagnostics);
        plausible::check(&mut settled.zero, cycle, None, diagnostics);
        plausible::check(&mut settled.external, cycle, None, diagnostics);
        plausible::channel::check(&mut settled.channel, diagnostics);
        diagnostics.append(&mut default_couplings(&settled.channel).1);
        inert::check(&settled.start_up, None, diagnostics);
        inert::check(&settled.channel, None, diagnostics);
        inert::check(&settled.tools, None, diagnostics);
        inert::check(&settled.external, None, diagnostics);
        for axis in &mut settled.axes {
            let number = logical_number(&axis.parameters);
            let name = names.name(number).unwrap_or_default().to_owned();
            let axis_ref = AxisRef { number, name };
            plausible::check(&mut axis.parameters, cycle, Some(&axis_ref), diagnostics);
            inert::check(&axis.parameters, Some(&axis_ref), diagnostics);
            plausible::check_sampling(
                &axis.parameters,
                &settled.own,
                cycle,
                &axis_ref,
                diagnostics,
            );
        }
        cycle
    }
}
