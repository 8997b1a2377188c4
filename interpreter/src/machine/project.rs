//! The lists inside a TwinCAT project: `.tsproj`, and `.xti` files of its parts or of exported axes and channels.
//!
//! The engineering tool keeps every list of the CNC as text inside XML. The texts are extracted unchanged, each with
//! its position in the file, so that messages refer to lines of the project. Values that the tool itself enters when it
//! activates a configuration (names, numbers and count of the axes, cycle of the GEO task) are entered here as well,
//! and reported in one note.
//!
//! The vendor does not document these files. Assumption: the elements are those that public tools for such projects
//! use. An axis contains `AchsMds`, a channel `SdaMds`, `NullpD`, `WerkzD`, `PzvD`, `VeD`; next to the list of an axis
//! are `ItemName` and the fields of its dialog `DefaultChannel` (from 1), `DefaultIndex` (from 0) and
//! `DefaultProgName`. A text with keys of a start-up list is treated as one, whatever its element is called; lists of
//! defaults are called `DefaultAchsMds`, `DefaultSdaMds`.
//!
//! Order of calls: the files of a project, the lists inside them, then the same readers as for lists in files.
//!
//! ```
//! use kontur_interpreter::machine::Machine;
//! use kontur_interpreter::machine::lists::ListFiles;
//! use kontur_interpreter::machine::project::{Part, Project};
//!
//! struct NoFiles;
//! impl ListFiles for NoFiles {
//!     fn read(&self, _: &str) -> Result<Option<Vec<u8>>, String> {
//!         Ok(None)
//!     }
//! }
//! let text = "<P><Axis><ItemName>X-Axis</ItemName><DefaultChannel>1</DefaultChannel><DefaultProgName>X</DefaultProgName>
//! <AchsMds><![CDATA[
//! kopf.achs_nr 1
//! getriebe[0].kv 2000
//! ]]></AchsMds></Axis><Channel><SdaMds/></Channel></P>";
//! let part = Part { name: "machine.tsproj".to_owned(), text: text.to_owned() };
//! let project = Project::read(&NoFiles, "machine.tsproj", &[part], true).unwrap();
//! let (machine, _) = Machine::load(&project, project.start_up(), &[]).unwrap();
//! assert_eq!(machine.axes[0].name(), "X");
//! ```

mod axes;
mod content;
mod list;

use super::chain::{OWN_LIST, SEPARATORS, beside};
use super::kind::{AxisKind, kind_of};
use super::lists::{self, ListFiles};
use super::table::{ListKind, channel as of, own};
use crate::diag::{Condition, Diagnostic, Severity};
use axes::spindles_of;
use content::Content;
pub use content::Part;
use kontur_filters::time::CycleTime;
use list::{ListText, parameters};
use std::collections::BTreeMap;
use std::fmt::{self, Write as _};

/// The lists of a project as files: those in the XML, and real files for the rest.
pub struct Project<'a> {
    files: &'a dyn ListFiles,
    start_up: String,
    lists: BTreeMap<String, String>,
    said: Vec<Diagnostic>,
}

/// Beginnings of the keys of the start-up list that name lists.
const NAMING_LISTS: [&str; 11] = [
    "listen",
    "kanal_anzahl",
    "zahl_mds",
    "achs_mds[",
    "default_achs_mds",
    "default_sda_mds",
    "sda_mds[",
    "werkz_data[",
    "nullp_data[",
    "ve_var[",
    "ext_var[",
];

impl fmt::Debug for Project<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Project").field("lists", &self.lists.keys()).finish_non_exhaustive()
    }
}

impl ListFiles for Project<'_> {
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        match self.lists.get(path) {
            Some(list) => Ok(Some(list.clone().into_bytes())),
            None => self.files.read(path),
        }
    }

    fn in_other_case(&self, path: &str) -> Option<String> {
        self.files.in_other_case(path)
    }
}

impl<'a> Project<'a> {
    /// Extracts the lists from the parts. `name` is the path of the project in messages; `files` may have a
    /// `kontur.lis` next to it. `cycle_given`: the cycle is set above all lists, so that the project need not state
    /// one.
    ///
    /// # Errors
    /// K-0141 for a part that is not XML, for a project without axes or channel of a CNC or without the name of an
    /// axis, and for axis lists of which some but not all have the same number.
    pub fn read(
        files: &'a dyn ListFiles,
        name: &str,
        parts: &[Part],
        cycle_given: bool,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut content = Content::default();
        let wrong: Vec<Diagnostic> =
            parts.iter().filter_map(|part| content.add(part).err()).map(|e| *e).collect();
        if !wrong.is_empty() {
            return Err(wrong);
        }
        let left_out = content.settle();
        let start_up = name.to_owned();
        if content.axes.is_empty() || content.channels.is_empty() {
            let missing = if content.axes.is_empty() {
                "axis list (AchsMds)"
            } else {
                "channel list (SdaMds)"
            };
            let mut message =
                format!("{start_up} and its parts do not contain the {missing} of a CNC");
            let named = content.missing();
            if !named.is_empty() {
                let _ = write!(message, "; named but not found: {}", named.join(", "));
            }
            if !left_out.is_empty() {
                let _ = write!(message, "; omitted: {}", left_out.join(", "));
            }
            return Err(vec![Diagnostic::new(Condition::ProjectWrong, message)]);
        }
        let mut project = Self { files, start_up, lists: BTreeMap::new(), said: Vec::new() };
        let missing = content.missing();
        if !missing.is_empty() {
            let message = format!(
                "named by {} but not found: {}; its content is missing in the machine",
                project.start_up,
                missing.join(", ")
            );
            let said = Diagnostic::new(Condition::ProjectRead, message).severity(Severity::Warning);
            project
                .said
                .push(said.hint("copy the folder _Config of the project with all its files"));
        }
        project.fill(content, &left_out, cycle_given)?;
        Ok(project)
    }

    /// Name of the start-up list for [`Machine::load`](super::Machine::load).
    pub fn start_up(&self) -> &str {
        &self.start_up
    }

    /// What was extracted from the project: K-0140.
    pub fn said(&self) -> &[Diagnostic] {
        &self.said
    }

    /// Stores a list and returns its name for the start-up list.
    fn keep(&mut self, list: &ListText) -> String {
        let folder = self.start_up.rfind(SEPARATORS).map_or("", |at| &self.start_up[..=at]);
        let inside = list.file.strip_prefix(folder).unwrap_or(&list.file);
        let plain = |text: &str| -> String {
            let of = |c: char| if c.is_alphanumeric() || "._-/ ".contains(c) { c } else { '_' };
            text.chars().map(of).collect()
        };
        let mut name = format!("{}#{}", plain(inside), plain(&list.name));
        while self.lists.contains_key(&self.path(&name)) {
            name.push('\'');
        }
        self.lists.insert(self.path(&name), list.placed());
        name
    }

    fn path(&self, name: &str) -> String {
        beside(&self.start_up, name)
    }

    fn fill(
        &mut self,
        mut content: Content,
        left_out: &[String],
        cycle_given: bool,
    ) -> Result<(), Vec<Diagnostic>> {
        let axes = content.axis_parameters();
        let (numbers, renumbered) = content.number_axes(&axes)?;
        let spindle: Vec<bool> =
            axes.iter().map(|axis| kind_of(axis) == AxisKind::Spindle).collect();
        let named = content.name_axes(&numbers, &spindle, &mut self.said);
        let channel = content.channel_defaults.iter().chain([&content.channels[0].list]);
        let channel = parameters(ListKind::Channel, &channel.collect::<Vec<_>>());
        if channel.set_by(of::AXIS_NAME.and(0).place()).is_none() {
            let name = &content.channels[0].list.name;
            let message = format!(
                "the channel `{name}` does not name an axis, neither in a dialog nor in its list"
            );
            let hint = "set the names of the axes in programs (DefaultProgName), or list them in the channel";
            return Err(vec![Diagnostic::new(Condition::ProjectWrong, message).hint(hint)]);
        }

        let entries = self.list_entries(&content);
        let mut start_up = content.start_up.take().unwrap_or_default();
        start_up.replace(&NAMING_LISTS, &entries);
        self.lists.insert(self.start_up.clone(), start_up.placed());

        let mut note = spindles_of(&channel);
        note.push_str(renumbered);
        note.push_str(&self.cycle(content.cycle_100ns, cycle_given));
        if !left_out.is_empty() {
            let _ = write!(note, "; omitted: {}", left_out.join(", "));
        }
        if !content.channels[0].unread.is_empty() {
            let _ = write!(note, "; not read: {}", content.channels[0].unread.join(", "));
        }
        let list: Vec<String> =
            named.iter().map(|(name, number)| format!("{name} ({number})")).collect();
        let message = format!(
            "machine of {}: {} axis lists, channel `{}` with {}{note}",
            self.start_up,
            axes.len(),
            content.channels[0].list.name,
            if list.is_empty() {
                "the axes of its list".to_owned()
            } else {
                format!("the axes {}", list.join(", "))
            }
        );
        self.said.insert(0, Diagnostic::new(Condition::ProjectRead, message));
        self.others_left_out(&content);
        Ok(())
    }

    /// Entries of the start-up list that name the lists of the project, which are kept.
    fn list_entries(&mut self, content: &Content) -> String {
        let axes = content.axes.len();
        let mut entries = format!("listen ASCII\nkanal_anzahl 1\nzahl_mds {axes}\n");
        for (i, axis) in content.axes.iter().enumerate() {
            let _ = writeln!(entries, "achs_mds[{i}] \"{}\"", self.keep(&axis.list));
        }
        let first = &content.channels[0];
        let channel_lists = [
            ("default_achs_mds", content.axis_defaults.as_ref()),
            ("default_sda_mds", content.channel_defaults.as_ref()),
            ("sda_mds[0]", Some(&first.list)),
            ("werkz_data[0]", first.tools.as_ref()),
            ("nullp_data[0]", first.zero_offsets.as_ref()),
            ("ve_var[0]", first.external.as_ref()),
        ];
        for (key, list) in channel_lists {
            if let Some(list) = list {
                let _ = writeln!(entries, "{key} \"{}\"", self.keep(list));
            }
        }
        entries
    }

    /// Says which channels are not simulated.
    fn others_left_out(&mut self, content: &Content) {
        if let [first, others @ ..] = content.channels.as_slice()
            && !others.is_empty()
        {
            let names: Vec<&str> = others.iter().map(|c| c.list.name.as_str()).collect();
            let message = format!(
                "one channel is simulated, the first, `{}`; not simulated: {}",
                first.list.name,
                names.join(", ")
            );
            let said = Diagnostic::new(Condition::ProjectRead, message).severity(Severity::Warning);
            let hint = "export the axes and the channel to be simulated, and name their folder";
            self.said.push(said.hint(hint));
        }
    }

    /// Enters the cycle of the project, in units of 100 ns, into `kontur.lis`, unless the file next to the project has
    /// one. Returns a description for the note, and warns if the run would use a cycle that is not stated anywhere.
    fn cycle(&mut self, units_100ns: Option<u32>, given: bool) -> String {
        let path = self.path(OWN_LIST);
        let real = match lists::find(self.files, &path) {
            Ok(Some(found)) => String::from_utf8_lossy(&found.bytes).into_owned(),
            Ok(None) => String::new(),
            // it is read again with the other lists, which report why it cannot be read
            Err(_) => return String::new(),
        };
        let mut list = ListText::of(&real);
        let listed =
            parameters(ListKind::Kontur, &[&list]).set_by(own::CYCLE_TIME.place()).is_some();
        let replaced = if listed { ", replaced by that of kontur.lis" } else { "" };
        let why = match units_100ns {
            Some(units) if units % 10 == 0 => {
                let us = units / 10;
                if !listed {
                    list.enter(&format!("kontur.cycle_time_us {us}"));
                    self.lists.insert(path, list.text);
                }
                return format!("; cycle {us} us of the GEO task{replaced}");
            }
            Some(units) => format!(
                "the cycle {} us of the GEO task is not a whole number of microseconds",
                f64::from(units) / 10.0
            ),
            None => "no GEO task with a cycle".to_owned(),
        };
        if !listed && !given {
            let message = format!("{why}: {} us is assumed", CycleTime::DEFAULT.us());
            let said = Diagnostic::new(Condition::ProjectRead, message).severity(Severity::Warning);
            let hint = "write kontur.cycle_time_us into the kontur.lis next to the project, or use --cycle-us";
            self.said.push(said.hint(hint));
        }
        format!("; {why}{replaced}")
    }
}
