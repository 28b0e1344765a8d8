import { autocompletion, completionKeymap, type CompletionSource } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap } from '@codemirror/commands';
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import { linter } from '@codemirror/lint';
import { EditorState } from '@codemirror/state';
import { EditorView, keymap } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { ENUMS_FILE, enumNames } from '@/model/enums';
import { isProblem, readScript } from '@/model/script';
import { useProjectStore } from '@/store/project';
import { currentText } from '@/store/project/files';
import { scriptText } from '@/ui/scriptText';
import classes from './Inspector.module.css';

const STATUSES = ['SUCCESS', 'FAILURE', 'RUNNING', 'SKIPPED'] as const;

const language = StreamLanguage.define<null>({
  name: 'btscript',
  token: (stream) => {
    if (stream.eatSpace()) return null;
    if (stream.match(/^'[^']*'?/)) return 'string';
    if (stream.match(/^(0[xX][0-9a-fA-F]+|\d+(\.\d+)?([eE][+-]?\d+)?)/)) return 'number';
    if (stream.match(/^(true|false|SUCCESS|FAILURE|RUNNING|SKIPPED)\b/)) return 'atom';
    if (stream.match(/^[A-Za-z_@]\w*/)) return 'variableName';
    stream.next();
    return 'operator';
  },
});

const colors = HighlightStyle.define([
  { tag: tags.string, color: 'var(--bts-code-string, #0b6e4a)' },
  { tag: tags.number, color: 'var(--bts-code-number, #a5400f)' },
  { tag: tags.atom, color: 'var(--bts-code-keyword, #8030b5)' },
  { tag: tags.variableName, color: 'var(--bts-accent)' },
]);

const look = EditorView.theme({
  '.cm-content': { padding: '5px 0', caretColor: 'var(--bts-text)', fontFamily: 'var(--bts-font-mono)' },
  '.cm-scroller': { fontSize: '12px', lineHeight: '1.5' },
  '&.cm-focused': { outline: 'none' },
  '.cm-tooltip': {
    color: 'var(--bts-text)',
    backgroundColor: 'var(--bts-surface)',
    border: '1px solid var(--bts-border)',
  },
  '.cm-tooltip-autocomplete ul li[aria-selected]': {
    color: 'var(--bts-text)',
    backgroundColor: 'var(--bts-accent-soft)',
  },
  '.cm-lintRange-error': {
    backgroundImage: 'none',
    textDecoration: 'underline wavy var(--bts-failure-bright)',
  },
});

/** Returns the completion of scripts: blackboard keys, names of enumerations, statuses and booleans. */
function completions(keys: () => readonly string[]): CompletionSource {
  return (context) => {
    const word = context.matchBefore(/[@A-Za-z_]\w*/);
    const inString = (context.state.sliceDoc(0, context.pos).split("'").length - 1) % 2 === 1;
    if (inString || (!word && !context.explicit)) return null;
    return {
      from: word?.from ?? context.pos,
      options: [
        ...keys().map((label) => ({ label, type: 'variable', boost: 1 })),
        ...enumNames(currentText(useProjectStore.getState(), ENUMS_FILE)).map((label) => ({
          label,
          type: 'enum',
        })),
        ...STATUSES.map((label) => ({ label, type: 'enum' })),
        ...['true', 'false'].map((label) => ({ label, type: 'constant' })),
      ],
      validFor: /^[@\w]*$/,
    };
  };
}

export interface ScriptEditorProps {
  readonly value: string;
  /** The blackboard keys for the completion. */
  readonly keys: readonly string[];
  readonly testId: string;
  readonly labelledBy?: string;
  readonly label?: string;
  /** Whether the field was just added: then it gets the caret and scrolls into view. */
  readonly isNew?: boolean;
  /** Returns the caret of the field that this editor replaces; null if that did not have the focus. */
  readonly takeCaret?: () => number | null;
  readonly onChange: (value: string) => void;
  readonly onLeave?: () => void;
  /** Called for Escape in an empty field. */
  readonly onCancel?: () => void;
}

/** A script editor with syntax colours, marks at errors, and completion; see ScriptInput. */
export function ScriptEditor(props: ScriptEditorProps) {
  const { value, testId, labelledBy, label } = props;
  const { t } = useTranslation();
  const host = useRef<HTMLDivElement>(null);
  const view = useRef<EditorView | null>(null);
  const latest = useRef({ ...props, t });
  useEffect(() => {
    latest.current = { ...props, t };
  });

  useEffect(() => {
    if (!host.current) return;
    const named: Record<string, string> = labelledBy
      ? { 'aria-labelledby': labelledBy }
      : { 'aria-label': label ?? '' };
    const editor = new EditorView({
      parent: host.current,
      state: EditorState.create({
        doc: latest.current.value,
        extensions: [
          language,
          syntaxHighlighting(colors),
          look,
          history(),
          EditorView.lineWrapping,
          autocompletion({ override: [completions(() => latest.current.keys)], icons: false }),
          keymap.of([
            {
              key: 'Escape',
              run: ({ state }) => {
                const { onCancel } = latest.current;
                if (!onCancel || state.doc.length > 0) return false;
                onCancel();
                return true;
              },
            },
          ]),
          EditorView.domEventHandlers({
            blur: () => {
              latest.current.onLeave?.();
            },
          }),
          keymap.of([...completionKeymap, ...defaultKeymap, ...historyKeymap]),
          EditorView.contentAttributes.of({ ...named, 'data-testid': testId, spellcheck: 'false' }),
          linter(
            ({ state }) => {
              const text = state.doc.toString();
              const facts = readScript(text);
              // The form reports an empty script beside the field.
              if (text.trim() === '' || !isProblem(facts)) return [];
              const { message, hint } = scriptText(facts, latest.current.t);
              const [from, to] = facts.span;
              const start = Math.min(from, Math.max(0, text.length - 1));
              return [
                {
                  from: start,
                  to: Math.max(to, start + 1),
                  severity: 'error',
                  message: `${message}\n${hint}`,
                },
              ];
            },
            { delay: 150 },
          ),
          EditorView.updateListener.of((update) => {
            if (!update.docChanged) return;
            const text = update.state.doc.toString();
            if (text !== latest.current.value) latest.current.onChange(text);
          }),
        ],
      }),
    });
    view.current = editor;
    const caret = latest.current.takeCaret?.() ?? null;
    if (latest.current.isNew || caret !== null) {
      const end = editor.state.doc.length;
      editor.dispatch({ selection: { anchor: Math.min(caret ?? end, end) } });
      editor.focus();
      host.current.scrollIntoView({ block: 'nearest' });
    }
    return () => {
      view.current = null;
      editor.destroy();
    };
  }, [testId, labelledBy, label]);

  useEffect(() => {
    const editor = view.current;
    if (!editor || editor.state.doc.toString() === value) return;
    editor.dispatch({ changes: { from: 0, to: editor.state.doc.length, insert: value } });
  }, [value]);

  return <div ref={host} className={classes['script']} />;
}
