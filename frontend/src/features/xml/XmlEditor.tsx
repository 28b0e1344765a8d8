import { indentUnit } from '@codemirror/language';
import { setDiagnostics } from '@codemirror/lint';
import { Annotation, Compartment, EditorState, Transaction } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { basics } from '@/features/code/basics';
import { useProjectStore } from '@/store/project';
import { problemsOf } from '@/store/project/problems';
import type { XmlLink, XmlSnapshot } from '@/store/xml/link';
import { useProblemText } from '@/ui/hooks/useProblemText';
import { pieceThatDiffers } from './difference';
import { findingMarks, problemMarks } from './marks';
import { dimMetadata, hiddenMetadata, nodeAt, nodeRanges, rangesOf, setRanges, setSelected } from './ranges';
import { treeXml } from './schema';
import frame from '@/features/code/editorFrame.module.css';
import classes from './xml.module.css';

interface XmlEditorProps {
  readonly treeId: string;
  readonly link: XmlLink;
  readonly snapshot: XmlSnapshot;
  readonly showsMetadata: boolean;
}

type ViewRef = { readonly current: EditorView | null };

/** Marks changes that come from the tree, so that they are not sent back as edits. */
const fromTree = Annotation.define<boolean>();
const language = new Compartment();
const metadata = new Compartment();

/** The editor of a tree's XML; its selection and that of the canvas follow each other. */
export function XmlEditor({ treeId, link, snapshot, showsMetadata }: XmlEditorProps) {
  const { t } = useTranslation('xml');
  const host = useRef<HTMLDivElement>(null);
  const view = useRef<EditorView | null>(null);
  const label = t('label', { tree: treeId });

  useEffect(() => {
    if (!host.current) return;
    const editor = new EditorView({
      parent: host.current,
      state: EditorState.create({ doc: link.get().text, extensions: extensions(label, link, treeId) }),
    });
    editor.dispatch({ effects: setRanges.of(link.get().ranges) });
    view.current = editor;
    return () => {
      view.current = null;
      editor.destroy();
    };
  }, [link, treeId, label]);

  useTreeText(view, snapshot);
  useLook(view, showsMetadata);
  useSelection(view, treeId, snapshot);
  useMarks(view, treeId, snapshot);
  return (
    <div
      ref={host}
      className={`${frame['editor']} ${classes['editor']}`}
      data-testid="xml-editor"
      data-tree={treeId}
    />
  );
}

function extensions(label: string, link: XmlLink, treeId: string) {
  return [
    basics(label),
    indentUnit.of('  '),
    language.of(treeXml(useProjectStore.getState().vocabulary)),
    metadata.of(hiddenMetadata),
    nodeRanges,
    EditorView.lineWrapping,
    EditorView.updateListener.of((update) => {
      if (update.transactions.some((change) => change.annotation(fromTree))) return;
      if (update.docChanged) link.edited(update.state.doc.toString());
      if (update.selectionSet && update.view.hasFocus) selectAt(update.view, treeId);
    }),
  ];
}

/** Selects the node at the cursor on the canvas. */
function selectAt(view: EditorView, treeId: string): void {
  const node = nodeAt(rangesOf(view), view.state.selection.main.head);
  const { select, diagrams } = useProjectStore.getState();
  if (node !== null && diagrams[treeId]?.nodes[node]) select(treeId, [node]);
}

/** Updates the text after a change of the tree. */
function useTreeText(view: ViewRef, { text, ranges }: XmlSnapshot): void {
  useEffect(() => {
    const editor = view.current;
    if (!editor) return;
    const changes = pieceThatDiffers(editor.state.doc.toString(), text);
    if (!changes) return;
    editor.dispatch({
      changes,
      annotations: [fromTree.of(true), Transaction.addToHistory.of(true)],
    });
  }, [view, text]);
  useEffect(() => {
    // The ranges belong to one text, so they are set together with it.
    view.current?.dispatch({ effects: setRanges.of(ranges) });
  }, [view, ranges]);
}

function useLook(view: ViewRef, showsMetadata: boolean): void {
  const vocabulary = useProjectStore((state) => state.vocabulary);
  useEffect(() => {
    view.current?.dispatch({
      effects: [
        language.reconfigure(treeXml(vocabulary)),
        metadata.reconfigure(showsMetadata ? dimMetadata : hiddenMetadata),
      ],
    });
  }, [view, vocabulary, showsMetadata]);
}

const NONE: readonly string[] = [];

/** Marks the nodes that are selected on the canvas, and scrolls to them. */
function useSelection(view: ViewRef, treeId: string, { ranges }: XmlSnapshot): void {
  const selection = useProjectStore((state) => (state.activeTree === treeId ? state.selection : NONE));
  useEffect(() => {
    view.current?.dispatch({ effects: setSelected.of(new Set(selection)) });
  }, [view, selection]);
  const first = selection[0];
  useEffect(() => {
    const editor = view.current;
    const range = editor && rangesOf(editor).find(({ node }) => node === first);
    if (!editor || !range || editor.hasFocus || range.start > editor.state.doc.length) return;
    editor.dispatch({ effects: EditorView.scrollIntoView(range.start, { y: 'nearest', yMargin: 60 }) });
  }, [view, first, ranges]);
}

function useMarks(view: ViewRef, treeId: string, { state, text, ranges }: XmlSnapshot): void {
  const diagram = useProjectStore((store) => store.diagrams[treeId]);
  const vocabulary = useProjectStore((store) => store.vocabulary);
  const diagnostics = useProjectStore((store) => store.diagnostics);
  const textOf = useProblemText();
  const say = useRef(textOf);
  useEffect(() => {
    say.current = textOf;
  });
  useEffect(() => {
    const editor = view.current;
    if (!editor || !diagram) return;
    const { doc } = editor.state;
    const found = state.kind === 'broken' || state.kind === 'inStep' ? state.findings : [];
    const problems = state.kind === 'inStep' ? problemsOf(diagram, vocabulary, diagnostics) : [];
    editor.dispatch(
      setDiagnostics(editor.state, [
        ...findingMarks(doc, found),
        ...problemMarks(doc.length, rangesOf(editor), problems, say.current),
      ]),
    );
  }, [view, diagram, vocabulary, diagnostics, state, text, ranges]);
}
