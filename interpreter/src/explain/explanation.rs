//! The explanation of one term.

/// Kind of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An ID of a message.
    Message,
    /// A parameter of a list.
    Parameter,
    /// A command or G function.
    Command,
    /// A system variable.
    Variable,
    /// An object or word of the documents.
    Word,
}

/// The explanation of a term, in the order of printing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// Its kind.
    pub kind: Kind,
    /// Name: `P-AXIS-00212  getriebe[i].dynamik.vb_max`.
    pub title: String,
    /// Meaning in one or two sentences.
    pub meaning: String,
    /// Facts with their names: range, default, unit, ...
    pub facts: Vec<(&'static str, String)>,
    /// Remarks and recommendations.
    pub notes: Vec<String>,
    /// A line for a list or program.
    pub example: Option<String>,
    /// Related terms.
    pub related: Vec<String>,
}

impl std::fmt::Display for Explanation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(f, "{}", self.title)?;
        writeln!(f, "  {}", self.meaning)?;
        for (name, fact) in &self.facts {
            writeln!(f, "  {name:<10} {fact}")?;
        }
        for note in &self.notes {
            writeln!(f, "  note       {note}")?;
        }
        if let Some(example) = &self.example {
            writeln!(f, "  example    {example}")?;
        }
        if !self.related.is_empty() {
            writeln!(f, "  see also   {}", self.related.join(", "))?;
        }
        Ok(())
    }
}
