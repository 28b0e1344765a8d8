import { historyField } from '@codemirror/commands';
import { setDiagnostics } from '@codemirror/lint';
import { Annotation, EditorState, Transaction, type StateEffect } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { Center, Text } from '@mantine/core';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { reportOf, useTests } from '@/store/behaviourTests/report';
import { useLanguageStore } from '@/store/language';
import { lintSoon } from '@/store/problems/lint';
import { isSuperseded } from '@/store/problems/syntax';
import { useTextFindings } from '@/store/problems/texts';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { useTabs } from '@/workspace/tabs';
import frame from './editorFrame.module.css';
import { marksFor } from './diagnostics';
import { extensionsFor } from './extensions';
import { lintMarks, servedMark } from './findings';
import { applyKeptFontSize } from './fontSize';
import { changesBetween } from './language/ruff';
import { uriOf } from './language/uris';
import { LanguageStatus } from './LanguageStatus';
import { LargeFile } from './LargeFile';
import { ReferencesPanel } from './places/ReferencesPanel';
import { RenameDialog } from './places/RenameDialog';
import { testMarks } from './testMarks';
import { textMarks, useTextErrors } from './textErrors';

interface CodeTabProps {
  readonly path: string;
}

/** Marks changes that come from the store, so that they are not sent back as edits. */
const fromStore = Annotation.define<boolean>();

const KEPT = { history: historyField };

/**
 * The editor's state while the editor is created again, because its file or the page's language has changed.
 */
interface Left {
  readonly state: unknown;
  readonly scroll: StateEffect<unknown>;
  readonly hadFocus: boolean;
}

/** The text editor of one file of the project; a file that did not come with the project is loaded first. */
export function CodeTab({ path }: CodeTabProps) {
  const isLarge = useProjectStore((state) => state.files[path]?.kind === 'large');
  return isLarge ? <LargeFile path={path} /> : <FileEditor path={path} />;
}

function FileEditor({ path }: CodeTabProps) {
  const { t } = useTranslation('code');
  const host = useRef<HTMLDivElement>(null);
  const view = useRef<EditorView | null>(null);
  const left = useRef<Left | null>(null);
  const text = useProjectStore((state) => state.currentText(path));
  const isMissing = text === null;
  const label = t('editorOf', { path });

  useEffect(() => {
    if (!host.current || isMissing) return;
    applyKeptFontSize();
    const extensions = [
      extensionsFor(path, label),
      EditorView.updateListener.of((update) => {
        const isOurs = update.transactions.some((change) => change.annotation(fromStore));
        if (update.docChanged && !isOurs) {
          useProjectStore.getState().setFileText(path, update.state.doc.toString());
        }
      }),
    ];
    const before = left.current;
    const editor = new EditorView({
      parent: host.current,
      state: before
        ? EditorState.fromJSON(before.state, { extensions }, KEPT)
        : EditorState.create({ doc: useProjectStore.getState().currentText(path) ?? '', extensions }),
      ...(before ? { scrollTo: before.scroll } : {}),
    });
    if (before) follow(editor, useProjectStore.getState().currentText(path) ?? '');
    if (before?.hadFocus) editor.focus();
    view.current = editor;
    return () => {
      view.current = null;
      const { hasFocus: hadFocus } = editor;
      left.current = {
        state: editor.state.toJSON(KEPT) as unknown,
        scroll: editor.scrollSnapshot(),
        hadFocus,
      };
      editor.destroy();
    };
  }, [path, label, isMissing]);

  useExternalText(view, text);
  useTextErrors(path, text);
  useEffect(() => {
    lintSoon(path);
  }, [path]);
  useMarks(view, path, text, label);
  useLineTarget(view, path, text);

  if (isMissing) {
    return (
      <Center h="100%">
        <Text c="dimmed">{t('missing', { path })}</Text>
      </Center>
    );
  }
  return (
    <div className={frame['frame']}>
      <div ref={host} className={frame['editor']} data-testid="code-editor" data-path={path} />
      {path.endsWith('.py') ? (
        <>
          <ReferencesPanel onLeave={() => view.current?.focus()} />
          <RenameDialog uri={uriOf(path)} />
          <LanguageStatus path={path} />
        </>
      ) : null}
    </div>
  );
}

type ViewRef = { readonly current: EditorView | null };

/** Applies changes that were made elsewhere, such as a merge, a rename or another tab's save. */
function useExternalText(view: ViewRef, text: string | null): void {
  useEffect(() => {
    if (view.current && text !== null) follow(view.current, text);
  }, [view, text]);
}

/** Sets the text of an editor. Equal parts stay unchanged, so that cursors and marks in them stay. */
function follow(editor: EditorView, text: string): void {
  const before = editor.state.doc.toString();
  // The editor counts each line end as one character, whatever the file contains.
  const after = text.replace(/\r\n?/g, '\n');
  if (before === after) return;
  editor.dispatch({
    changes: changesBetween(before, after),
    annotations: [fromStore.of(true), Transaction.addToHistory.of(true)],
  });
}

/**
 * Marks the findings in a file. `label` is a dependency: a new label creates a new editor, which has no marks
 * yet.
 */
function useMarks(view: ViewRef, path: string, text: string | null, label: string): void {
  const served = useLanguageStore((state) => state.findings[path]);
  const linted = useTextFindings((state) => state.linted[path]);
  const errors = useTextFindings((state) => state.errors[path]);
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const faults = useSessionStore((state) => state.faults);
  const projectId = useProjectStore((state) => state.projectId);
  const report = useTests((state) => reportOf(state, projectId));
  useEffect(() => {
    const editor = view.current;
    if (!editor) return;
    const { doc } = editor.state;
    const found = { served, linted, errors };
    const saved = diagnostics.filter((item) => !isSuperseded(item, found));
    const marks = [
      ...marksFor(doc, path, saved, faults),
      ...(served ?? []).map((finding) => servedMark(doc, finding)),
      ...lintMarks(doc, found),
      ...textMarks(doc, errors),
      ...testMarks(doc, path, report),
    ];
    editor.dispatch(setDiagnostics(editor.state, marks));
    // When findings and text arrive together, the new text moves the marks, so they must be set again.
  }, [view, path, diagnostics, faults, text, served, linted, errors, report, label]);
}

function useLineTarget(view: ViewRef, path: string, text: string | null): void {
  const target = useTabs((state) => (state.target?.path === path ? state.target : null));
  const done = useRef(0);
  useEffect(() => {
    const editor = view.current;
    if (!editor || !target || done.current === target.request || text === null) return;
    done.current = target.request;
    const line = editor.state.doc.line(Math.min(target.line, editor.state.doc.lines));
    const indent = line.text.length - line.text.trimStart().length;
    editor.dispatch({
      selection: { anchor: line.from + indent },
      effects: EditorView.scrollIntoView(line.from, { y: 'center' }),
    });
    editor.focus();
  }, [view, target, text]);
}
