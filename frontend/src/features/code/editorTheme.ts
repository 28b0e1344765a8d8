import { HighlightStyle, syntaxHighlighting } from '@codemirror/language';
import { EditorView } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import './code.css';

/** Documentation must not cover the page: what does not fit scrolls. */
const SMALL = {
  maxWidth: 'min(480px, 90vw)',
  maxHeight: '260px',
  overflow: 'auto',
  overflowWrap: 'anywhere',
} as const;

/** The theme of the editor. Its colours are tokens, so that it serves both the light and the dark theme. */
const look = EditorView.theme({
  '&': { height: '100%', color: 'var(--bts-text)', backgroundColor: 'var(--bts-surface)' },
  '.cm-scroller': {
    fontFamily: 'var(--bts-font-mono)',
    fontSize: 'var(--bts-code-size, 13px)',
    lineHeight: '1.6',
  },
  '.cm-content': { caretColor: 'var(--bts-accent)', paddingBlock: '8px' },
  '.cm-cursor': { borderLeftColor: 'var(--bts-accent)', borderLeftWidth: '2px' },
  '&.cm-focused': { outline: 'none' },
  '.cm-gutters': {
    color: 'var(--bts-muted)',
    backgroundColor: 'var(--bts-surface)',
    border: 'none',
    paddingInline: '4px',
  },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'var(--bts-surface-2)' },
  '.cm-activeLineGutter': { color: 'var(--bts-text)' },
  '&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground': {
    backgroundColor: 'var(--bts-accent-soft)',
  },
  '.cm-matchingBracket, &.cm-focused .cm-matchingBracket': {
    backgroundColor: 'var(--bts-surface-3)',
    outline: '1px solid var(--bts-border-strong)',
  },
  '.cm-tooltip': {
    color: 'var(--bts-text)',
    backgroundColor: 'var(--bts-surface)',
    border: '1px solid var(--bts-border)',
    borderRadius: 'var(--bts-radius-small)',
    boxShadow: 'var(--bts-shadow-raised)',
  },
  // A finding stays next to the text when the documentation of the name arrives later.
  '.cm-tooltip-hover': { display: 'flex', flexDirection: 'column', ...SMALL },
  '.cm-tooltip.cm-completionInfo': SMALL,
  // The sections of a docstring are headings, which would be larger than the text of the page.
  '.cm-lsp-documentation': {
    '& h1, & h2, & h3': { fontSize: 'inherit', fontWeight: 600, margin: '6px 0 2px' },
    '& ul, & ol': { margin: '2px 0', paddingInlineStart: '20px' },
  },
  '.cm-tooltip-above .cm-tooltip-lint': { order: 1 },
  '.cm-tooltip-below .cm-tooltip-lint': { order: -1 },
  '.cm-tooltip-autocomplete ul li[aria-selected]': {
    color: 'var(--bts-text)',
    backgroundColor: 'var(--bts-accent-soft)',
  },
  '.cm-panels': { color: 'var(--bts-text)', backgroundColor: 'var(--bts-surface-2)' },
  '.cm-lintRange-error': {
    backgroundImage: 'none',
    textDecoration: 'underline wavy var(--bts-failure-bright)',
    textUnderlineOffset: '3px',
  },
  '.cm-lintRange-warning': {
    backgroundImage: 'none',
    textDecoration: 'underline wavy var(--bts-running-bright)',
    textUnderlineOffset: '3px',
  },
  '.cm-collapsedLines': {
    color: 'var(--bts-muted)',
    background: 'var(--bts-surface-2)',
    '&:before, &:after': { content: '"⋯"' },
  },
  '.cm-faultLine': { backgroundColor: 'var(--bts-failure-soft)' },
});

const highlighting = HighlightStyle.define([
  { tag: [tags.keyword, tags.operatorKeyword, tags.modifier], color: 'var(--bts-code-keyword)' },
  { tag: [tags.string, tags.special(tags.string)], color: 'var(--bts-code-string)' },
  { tag: [tags.number, tags.bool, tags.null], color: 'var(--bts-code-number)' },
  { tag: [tags.comment, tags.docString], color: 'var(--bts-muted)', fontStyle: 'italic' },
  {
    tag: [tags.function(tags.variableName), tags.function(tags.propertyName)],
    color: 'var(--bts-code-call)',
  },
  { tag: [tags.definition(tags.variableName), tags.className], color: 'var(--bts-code-name)' },
  { tag: [tags.tagName, tags.propertyName], color: 'var(--bts-code-name)' },
  { tag: [tags.attributeName, tags.self], color: 'var(--bts-code-keyword)' },
  { tag: tags.meta, color: 'var(--bts-muted)' },
  { tag: tags.invalid, color: 'var(--bts-failure)' },
]);

export const editorTheme = [look, syntaxHighlighting(highlighting)];
