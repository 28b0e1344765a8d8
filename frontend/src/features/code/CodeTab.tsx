import { setDiagnostics } from '@codemirror/lint';
import { Annotation, EditorState, Transaction } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { Center, Text } from '@mantine/core';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { useLanguageStore } from '@/store/language';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { useTabs } from '@/features/frame/tabs';
import frame from './editorFrame.module.css';
import { marksFor } from './diagnostics';
import { extensionsFor } from './extensions';
import { isOurs, lintMarks, servedMark } from './findings';
import { applyKeptFontSize } from './fontSize';
import { LanguageStatus } from './LanguageStatus';
import { useFindings, type Linted } from './useFindings';

interface CodeTabProps {
  readonly path: string;
}

/** Marks changes that came from the store, so that they are not sent back as edits. */
const fromStore = Annotation.define<boolean>();

/** One file of the project, editable. */
export function CodeTab({ path }: CodeTabProps) {
  const { t } = useTranslation('code');
  const host = useRef<HTMLDivElement>(null);
  const view = useRef<EditorView | null>(null);
  const text = useProjectStore((state) => state.currentText(path));
  const isMissing = text === null;
  const label = t('editorOf', { path });

  useEffect(() => {
    if (!host.current || isMissing) return;
    applyKeptFontSize();
    const editor = new EditorView({
      parent: host.current,
      state: EditorState.create({
        doc: useProjectStore.getState().currentText(path) ?? '',
        extensions: [
          extensionsFor(path, label),
          EditorView.updateListener.of((update) => {
            const isOurs = update.transactions.some((change) => change.annotation(fromStore));
            if (update.docChanged && !isOurs) {
              useProjectStore.getState().setFileText(path, update.state.doc.toString());
            }
          }),
        ],
      }),
    });
    view.current = editor;
    return () => {
      view.current = null;
      editor.destroy();
    };
  }, [path, label, isMissing]);

  useExternalText(view, text);
  const findings = useFindings(path, text);
  useMarks(view, path, text, findings);
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
      {path.endsWith('.py') ? <LanguageStatus path={path} /> : null}
    </div>
  );
}

type ViewRef = { readonly current: EditorView | null };

/** Follows changes made elsewhere: a merge, a rename, another tab's save. */
function useExternalText(view: ViewRef, text: string | null): void {
  useEffect(() => {
    const editor = view.current;
    if (!editor || text === null || editor.state.doc.toString() === text) return;
    editor.dispatch({
      changes: { from: 0, to: editor.state.doc.length, insert: text },
      annotations: [fromStore.of(true), Transaction.addToHistory.of(true)],
    });
  }, [view, text]);
}

function useMarks(view: ViewRef, path: string, text: string | null, linted: Linted | null): void {
  const served = useLanguageStore((state) => state.findings[path]);
  const isServed = useLanguageStore((state) => state.state.kind === 'ready');
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const faults = useSessionStore((state) => state.faults);
  useEffect(() => {
    const editor = view.current;
    if (!editor) return;
    const { doc } = editor.state;
    const marks = [
      ...marksFor(doc, path, isServed ? diagnostics.filter(isOurs) : diagnostics, faults),
      ...(served ?? []).map((finding) => servedMark(doc, finding)),
      ...lintMarks(doc, linted, isServed),
    ];
    editor.dispatch(setDiagnostics(editor.state, marks));
    // A text that came with the marks moves them: they are set again for it.
  }, [view, path, diagnostics, faults, text, served, isServed, linted]);
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
