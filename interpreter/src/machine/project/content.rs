//! Content of the XML of a project: texts of lists with their positions, and the fields next to them.

use super::list::ListText;
use crate::diag::{Condition, Diagnostic, Location};
use crate::machine::chain::SEPARATORS;
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::BTreeSet;

/// Largest number of elements and texts of one file; with more it cannot come from an engineering tool.
const NODES_MAX: u32 = 1_000_000;
/// Levels between a list and the fields of its item.
const LEVELS_MAX: usize = 6;
/// Most axis lists of a control (P-STUP-00015).
const AXES_MAX: usize = 32;

/// Most channels of a control (P-STUP-00001).
const CHANNELS_MAX: usize = 12;

/// One file of a project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Path as the user gave it, in the folder of the project.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// An axis of the project.
#[derive(Clone, Debug)]
pub(super) struct AxisItem {
    /// Its list.
    pub(super) list: ListText,
    /// Whether it is switched off in the tree of the project.
    disabled: bool,
    /// Channel it belongs to from the start, from 1.
    pub(super) channel: Option<u32>,
    /// Position in that channel, from 0.
    pub(super) index: u32,
    /// Name in programs.
    pub(super) program_name: String,
}

/// A channel of the project.
#[derive(Clone, Debug)]
pub(super) struct ChannelItem {
    /// Its list.
    pub(super) list: ListText,
    /// Its number in the project.
    id: Option<u32>,
    /// Whether it is switched off in the tree of the project.
    disabled: bool,
    /// List of tools.
    pub(super) tools: Option<ListText>,
    /// List of zero offsets.
    pub(super) zero_offsets: Option<ListText>,
    /// List of external variables.
    pub(super) external: Option<ListText>,
    /// Elements with entries that are not read here.
    pub(super) unread: Vec<&'static str>,
}

/// All CNC items of a project, in the order of its files.
#[derive(Clone, Debug, Default)]
pub(super) struct Content {
    pub(super) axes: Vec<AxisItem>,
    pub(super) channels: Vec<ChannelItem>,
    pub(super) axis_defaults: Option<ListText>,
    pub(super) channel_defaults: Option<ListText>,
    pub(super) start_up: Option<ListText>,
    /// Cycle of the GEO task in units of 100 ns.
    pub(super) cycle_100ns: Option<u32>,
    /// Items in separate files.
    references: Vec<Reference>,
    /// The files that were read, by their base names.
    files: BTreeSet<String>,
}

/// An item that the project refers to, with the file that contains it.
#[derive(Clone, Debug)]
struct Reference {
    /// The base name of its file in lower case.
    file: String,
    /// The file as written in the project.
    written: String,
    /// Whether it is an axis, a channel or a whole CNC rather than a terminal or a PLC program.
    of_cnc: bool,
    id: Option<u32>,
    disabled: bool,
}

/// The base name of a path in lower case.
fn file_name(path: &str) -> String {
    path.rsplit(SEPARATORS).next().unwrap_or_default().to_lowercase()
}

impl Content {
    /// Adds the content of a file.
    ///
    /// # Errors
    /// K-0141 if it is not XML, or has more axes or channels than a control.
    pub(super) fn add(&mut self, part: &Part) -> Result<(), Box<Diagnostic>> {
        let text = part.text.trim_start_matches('\u{feff}');
        let options = ParsingOptions { nodes_limit: NODES_MAX, ..ParsingOptions::default() };
        let document =
            Document::parse_with_options(text, options).map_err(|e| no_xml(part, text, &e))?;
        self.files.insert(file_name(&part.name));
        for node in document.descendants().filter(Node::is_element) {
            if let Some(file) = node.attribute("File") {
                self.references.push(Reference {
                    file: file_name(file),
                    written: file.to_owned(),
                    of_cnc: ["axis", "channel", "cnc"]
                        .iter()
                        .any(|tag| node.tag_name().name().eq_ignore_ascii_case(tag)),
                    id: number(node, "Id"),
                    disabled: is_disabled(node),
                });
            }
            match node.tag_name().name() {
                "AchsMds" if self.axes.len() == AXES_MAX => {
                    return Err(too_many(part, AXES_MAX, "axis lists"));
                }
                "SdaMds" if self.channels.len() == CHANNELS_MAX => {
                    return Err(too_many(part, CHANNELS_MAX, "channel lists"));
                }
                "AchsMds" => self.axes.push(axis(part, node, self.axes.len())),
                "SdaMds" => self.channels.push(channel(part, node, self.channels.len())),
                "DefaultAchsMds" => self.axis_defaults = list(part, node, "defaults of axes"),
                "DefaultSdaMds" => self.channel_defaults = list(part, node, "defaults of channels"),
                "NullpD" | "WerkzD" | "PzvD" | "VeD" => {}
                _ if node.attribute("CycleTime").is_some() => self.task(node),
                _ if is_start_up(node) => self.start_up = list(part, node, "start-up list"),
                _ => {}
            }
        }
        Ok(())
    }

    /// Keeps the items that the project refers to and has switched on, with its channels in the order of their numbers;
    /// returns the items that are left out and the reasons.
    ///
    /// Assumptions: the references of a project (`File`) determine which of the files next to it belong to it, unless
    /// they refer to none of those with lists, as among exported items; an item with `Disabled` `true` or `1`, or inside one,
    /// is not activated.
    pub(super) fn settle(&mut self) -> Vec<String> {
        let named = |list: &ListText| {
            let name = file_name(&list.file);
            self.references.iter().find(|reference| reference.file == name)
        };
        let axes = self.axes.iter().map(|axis| &axis.list);
        let mut lists = axes.chain(self.channels.iter().map(|channel| &channel.list));
        let any_named = lists.any(|list| named(list).is_some());
        let mut left_out = Vec::new();
        let mut stays = |list: &ListText, disabled: bool| {
            let reference = named(list);
            let is_part = file_name(&list.file).rsplit('.').next() == Some("xti");
            let why = if disabled || reference.is_some_and(|r| r.disabled) {
                "switched off"
            } else if any_named && is_part && reference.is_none() {
                "not named by the project"
            } else {
                return true;
            };
            left_out.push(format!("`{}` of {} ({why})", list.name, list.file));
            false
        };
        let axes = self.axes.iter().map(|axis| stays(&axis.list, axis.disabled));
        let axes: Vec<bool> = axes.collect();
        let channels = self.channels.iter().map(|c| stays(&c.list, c.disabled));
        let channels: Vec<bool> = channels.collect();
        let ids: Vec<Option<u32>> =
            self.channels.iter().map(|c| named(&c.list).and_then(|r| r.id).or(c.id)).collect();
        for (channel, id) in self.channels.iter_mut().zip(ids) {
            channel.id = id;
        }
        let (mut axes, mut channels) = (axes.into_iter(), channels.into_iter());
        self.axes.retain(|_| axes.next().unwrap_or(true));
        self.channels.retain(|_| channels.next().unwrap_or(true));
        self.channels.sort_by_key(|channel| channel.id.unwrap_or(u32::MAX));
        left_out
    }

    /// Files of axes and channels that the project refers to, has not switched off, and that were not read.
    pub(super) fn missing(&self) -> Vec<&str> {
        self.references
            .iter()
            .filter(|r| r.of_cnc && !r.disabled && !self.files.contains(&r.file))
            .map(|r| r.written.as_str())
            .collect()
    }

    /// Reads the cycle of the interpolator task, which the tool stores in units of 100 ns.
    fn task(&mut self, node: Node<'_, '_>) {
        let name = node.attribute("Name").or_else(|| child(node, "Name")).unwrap_or_default();
        let cycle = node.attribute("CycleTime").and_then(|text| text.trim().parse::<u32>().ok());
        if name.to_ascii_uppercase().contains("GEO") && self.cycle_100ns.is_none() {
            self.cycle_100ns = cycle.filter(|units| *units > 0);
        }
    }
}

fn too_many(part: &Part, most: usize, what: &str) -> Box<Diagnostic> {
    let message = format!("{}: more than {most} {what}", part.name);
    Box::new(Diagnostic::new(Condition::ProjectWrong, message))
}

fn no_xml(part: &Part, text: &str, e: &roxmltree::Error) -> Box<Diagnostic> {
    let at = e.pos();
    let line = text.split('\n').nth(at.row.saturating_sub(1) as usize).unwrap_or_default();
    let place = Location {
        file: part.name.as_str().into(),
        line: at.row,
        column: at.col,
        offset: 0,
        length: 1,
        block: None,
        text: crate::source::text::beginning(line.trim_end()).into(),
    };
    Box::new(Diagnostic::new(Condition::ProjectWrong, format!("no XML: {e}")).at(place))
}

/// Value of a numeric attribute.
fn number(node: Node<'_, '_>, attribute: &str) -> Option<u32> {
    node.attribute(attribute)?.trim().parse().ok()
}

/// Whether an item, or one around it, is switched off in the tree of the project.
fn is_disabled(node: Node<'_, '_>) -> bool {
    node.ancestors()
        .filter_map(|item| item.attribute("Disabled"))
        .any(|text| matches!(text, "true" | "1"))
}

/// Texts and CDATA sections of an element itself.
fn texts<'a>(node: Node<'a, '_>) -> impl Iterator<Item = &'a str> {
    node.children().filter(Node::is_text).filter_map(|text| text.text())
}

/// Whether a text has entries that occur only in a start-up list.
fn is_start_up(node: Node<'_, '_>) -> bool {
    let begins = |line: &str| {
        ["configuration.channel[", "kanal_anzahl", "zahl_mds", "error_protocol_mode"]
            .iter()
            .any(|key| line.trim_start().starts_with(key))
    };
    texts(node).any(|text| text.lines().any(begins))
}

/// The list in an element.
fn list_text(part: &Part, node: Node<'_, '_>, name: String) -> ListText {
    let first = node.children().find(Node::is_text).unwrap_or(node).range().start;
    let before = node.document().text_pos_at(first).row.saturating_sub(1) as usize;
    ListText { file: part.name.clone(), name, text: texts(node).collect(), before }
}

/// The list in an element, `None` without entries.
fn list(part: &Part, node: Node<'_, '_>, name: &str) -> Option<ListText> {
    let entry = |line: &str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    texts(node).any(|text| text.lines().any(entry)).then(|| list_text(part, node, name.to_owned()))
}

/// The text of a child element.
fn child<'a>(node: Node<'a, '_>, tag: &str) -> Option<&'a str> {
    node.children().find(|child| child.tag_name().name() == tag)?.text().map(str::trim)
}

/// The nearest element of a name that belongs to the same item.
fn near<'a, 'i>(node: Node<'a, 'i>, tag: &str) -> Option<Node<'a, 'i>> {
    let own = node.tag_name().name();
    for scope in node.ancestors().skip(1).take(LEVELS_MAX) {
        let mut same = scope.descendants().filter(|other| other.tag_name().name() == own);
        if same.nth(1).is_some() {
            return None;
        }
        let mut all = scope.descendants();
        if let Some(found) = all.find(|other| other.tag_name().name() == tag) {
            return Some(found);
        }
    }
    None
}

/// Name of the item of a list.
fn name(node: Node<'_, '_>, otherwise: &str) -> String {
    let named = ["ItemName", "Name"].iter().find_map(|tag| near(node, tag)?.text());
    named.map(str::trim).filter(|name| !name.is_empty()).unwrap_or(otherwise).to_owned()
}

fn axis(part: &Part, node: Node<'_, '_>, count: usize) -> AxisItem {
    let field = |tag: &str| near(node, tag).and_then(|field| field.text()).map(str::trim);
    let number = |tag: &str| field(tag).and_then(|text| text.parse::<u32>().ok());
    AxisItem {
        list: list_text(part, node, name(node, &format!("axis {}", count + 1))),
        disabled: is_disabled(node),
        channel: number("DefaultChannel"),
        index: number("DefaultIndex").unwrap_or(count as u32),
        program_name: field("DefaultProgName").unwrap_or_default().to_owned(),
    }
}

fn channel(part: &Part, node: Node<'_, '_>, count: usize) -> ChannelItem {
    let beside = |tag: &str| list(part, near(node, tag)?, tag);
    ChannelItem {
        list: list_text(part, node, name(node, &format!("channel {}", count + 1))),
        id: node
            .ancestors()
            .find(|item| item.tag_name().name() == "Channel")
            .and_then(|item| number(item, "Id")),
        disabled: is_disabled(node),
        tools: beside("WerkzD"),
        zero_offsets: beside("NullpD"),
        external: beside("VeD"),
        unread: ["PzvD"].into_iter().filter(|tag| beside(tag).is_some()).collect(),
    }
}
