//! The reference: parameters, messages, commands, words, and the options of the command line, from the tables that the
//! programs themselves read.

use crate::markdown::{anchor, cell_code, code, escaped};
use clap::CommandFactory as _;
use kontur_interpreter::explain::{Explanation, Kind, all, explain};
use std::fmt::Write as _;

/// Name, title and introduction of a page, and the choice of its entries.
struct Page {
    name: &'static str,
    title: &'static str,
    text: &'static str,
    kind: Kind,
    takes: fn(&Explanation) -> bool,
}

const PAGES: &[Page] = &[
    Page {
        name: "parameters-axis.md",
        title: "Parameters of axes",
        text: "Keys of axis lists and of spindles. Units are those of the lists; `--set X.KEY=VALUE` overrides the list.",
        kind: Kind::Parameter,
        takes: |e| fact(e, "list") == "axis list",
    },
    Page {
        name: "parameters-channel.md",
        title: "Parameters of the channel",
        text: "Keys of the channel list, of the start-up list, of tools and zero offsets; `--set channel.KEY=VALUE` overrides the channel list.",
        kind: Kind::Parameter,
        takes: |e| !["axis list", "kontur.lis"].contains(&fact(e, "list")),
    },
    Page {
        name: "parameters-kontur.md",
        title: "Settings of kontur",
        text: "Keys of `kontur.lis`: settings that the vendor's lists do not contain. `--set kontur.KEY=VALUE` overrides the list.",
        kind: Kind::Parameter,
        takes: |e| fact(e, "list") == "kontur.lis",
    },
    Page {
        name: "messages-vendor.md",
        title: "Messages with the vendor's numbers",
        text: "A message has the vendor's number where a document gives one. Reaction and remedy are the vendor's classes.",
        kind: Kind::Message,
        takes: |e| !e.title.starts_with("K-"),
    },
    Page {
        name: "messages-kontur.md",
        title: "Messages of kontur",
        text: "Conditions without a number of the vendor's, and those of kontur itself. Numbers are never reused.",
        kind: Kind::Message,
        takes: |e| e.title.starts_with("K-"),
    },
    Page {
        name: "commands.md",
        title: "Commands and functions",
        text: "`#` commands and G and M functions with their keys. For the rest of the language, and for what is rejected, see [the table of the language](language.md).",
        kind: Kind::Command,
        takes: |_| true,
    },
    Page {
        name: "variables.md",
        title: "System variables",
        text: "Variables that programs can read, with X for the name of an axis, S for a spindle and i for an index. Others are declared by programs (`#VAR`) or are external (`V.E.`).",
        kind: Kind::Variable,
        takes: |_| true,
    },
    Page {
        name: "words.md",
        title: "Words",
        text: "Objects and words of the vendor's documents, and the reasons for a speed or a wait in traces and in `run --times`.",
        kind: Kind::Word,
        takes: |_| true,
    },
];

/// Name and text of every page.
pub(crate) fn pages() -> Vec<(&'static str, String)> {
    let mut pages: Vec<(&'static str, String)> =
        PAGES.iter().map(|page| (page.name, written(page))).collect();
    pages.push(("command-line.md", command_line()));
    pages
}

fn fact<'a>(e: &'a Explanation, name: &str) -> &'a str {
    e.facts.iter().find(|(n, _)| *n == name).map_or("", |(_, fact)| fact)
}

fn written(page: &Page) -> String {
    let mut out = format!("# {}\n\n{}\n", page.title, page.text);
    for e in all(page.kind).into_iter().filter(page.takes) {
        let _ = write!(out, "\n## {}\n\n{}\n", heading(&e.title), escaped(&e.meaning));
        let facts: Vec<_> = e.facts.iter().filter(|(name, _)| *name != "list").collect();
        if !facts.is_empty() {
            out.push_str("\n| | |\n|---|---|\n");
        }
        for (name, fact) in facts {
            // keys and forms are written in programs
            let fact = if *name == "form" { cell_code(fact) } else { escaped(fact) };
            let _ = writeln!(out, "| {name} | {fact} |");
        }
        for note in &e.notes {
            let _ = write!(out, "\n{}\n", escaped(note));
        }
        if let Some(example) = &e.example {
            let _ = write!(out, "\nExample: {}\n", code(example));
        }
        if !e.related.is_empty() {
            let related: Vec<String> = e.related.iter().map(|thing| link(thing)).collect();
            let _ = write!(out, "\nSee also {}\n", related.join(", "));
        }
    }
    out
}

/// `P-AXIS-00099  getriebe[i].kv`: the anchor of the heading is made from the name, so it contains no brackets.
fn heading(title: &str) -> String {
    escaped(&title.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// A thing with a link to its entry.
fn link(thing: &str) -> String {
    let entry = explain(thing).ok();
    let page = entry.as_ref().and_then(|e| PAGES.iter().find(|p| p.kind == e.kind && (p.takes)(e)));
    match (entry.as_ref(), page) {
        (Some(e), Some(page)) => {
            format!("[{}]({}#{})", escaped(thing), page.name, anchor(&heading(&e.title)))
        }
        _ => escaped(thing),
    }
}

/// The output of `--help` for every command.
fn command_line() -> String {
    let mut out = "# Command line\n\nOutput of `kontur COMMAND --help`. Results go to stdout, messages to stderr. Exit codes: 0 \
         finished, 1 refused or aborted by an NC or axis error, 2 wrong usage or machine lists, 3 input or output failed.\n"
        .to_owned();
    let mut command = kontur::args::Args::command().bin_name("kontur");
    command.build();
    for sub in command.get_subcommands_mut().filter(|c| c.get_name() != "help") {
        let name = sub.get_name().to_owned();
        let _ = write!(out, "\n## kontur {name}\n\n```text\n{}```\n", help(sub));
    }
    out
}

fn help(command: &mut clap::Command) -> String {
    let text = command.render_long_help().to_string();
    text.lines().flat_map(|line| [line.trim_end(), "\n"]).collect()
}

#[cfg(test)]
mod tests {
    use super::{PAGES, all, pages};
    use kontur_interpreter::explain::{Kind, explain};

    /// Every row of the tables is on exactly one page.
    #[test]
    fn every_row_has_its_entry() {
        for kind in [Kind::Parameter, Kind::Message, Kind::Command, Kind::Variable, Kind::Word] {
            for e in all(kind) {
                let taken = PAGES.iter().filter(|p| p.kind == kind && (p.takes)(&e));
                assert_eq!(taken.count(), 1, "{}", e.title);
            }
        }
        let pages = pages();
        let text = |name: &str| pages.iter().find(|p| p.0 == name).map_or("", |p| p.1.as_str());
        assert!(text("parameters-axis.md").contains("## P-AXIS-00099 getriebe\\[i\\].kv\n"));
        assert!(text("messages-vendor.md").contains("\n## 22060\n"));
        assert!(text("commands.md").contains("\n## \\#VIB GUARD\n"));
        assert!(text("command-line.md").contains("--techno-times"));
    }

    /// An entry says the same as `kontur explain`.
    #[test]
    fn entries_are_what_explain_prints() {
        for kind in [Kind::Parameter, Kind::Message, Kind::Variable, Kind::Word] {
            for e in all(kind) {
                let name = e.title.split("  ").next().unwrap();
                assert_eq!(explain(name).unwrap(), e);
            }
        }
    }
}
