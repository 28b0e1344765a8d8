import { MergeView as CodeMirrorMerge, unifiedMergeView } from '@codemirror/merge';
import { EditorState } from '@codemirror/state';
import { EditorView, lineNumbers } from '@codemirror/view';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import classes from './code.module.css';
import { editorTheme } from './editorTheme';
import { languageOf } from './modes';
import { phrases } from './phrases';
import { useIsNarrow } from '@/ui/hooks/useIsNarrow';

interface MergeViewProps {
  readonly path: string;
  readonly theirs: string;
  readonly mine: string;
  readonly onChange: (merged: string) => void;
}

/**
 * The server's version on the left; the user's on the right, editable, with arrows that copy pieces over. In a
 * narrow window it is one text, editable, where each difference is kept or taken back.
 */
export function MergeView({ path, theirs, mine, onChange }: MergeViewProps) {
  const { t } = useTranslation('code');
  const host = useRef<HTMLDivElement>(null);
  const changed = useRef(onChange);
  const text = useRef(mine);
  const isNarrow = useIsNarrow();
  useEffect(() => {
    changed.current = onChange;
  });
  useEffect(() => {
    if (!host.current) return;
    const shared = [lineNumbers(), languageOf(path), editorTheme, phrases()];
    const editable = [
      shared,
      EditorView.contentAttributes.of({ 'aria-label': t('conflict.mine') }),
      EditorView.updateListener.of((update) => {
        if (!update.docChanged) return;
        text.current = update.state.doc.toString();
        changed.current(text.current);
      }),
    ];
    if (isNarrow) {
      const unified = unifiedMergeView({ original: theirs });
      const state = EditorState.create({ doc: text.current, extensions: [editable, unified] });
      const view = new EditorView({ parent: host.current, state });
      return () => view.destroy();
    }
    const merge = new CodeMirrorMerge({
      parent: host.current,
      revertControls: 'a-to-b',
      a: {
        doc: theirs,
        extensions: [
          shared,
          EditorState.readOnly.of(true),
          EditorView.contentAttributes.of({ 'aria-label': t('conflict.theirs') }),
        ],
      },
      b: { doc: text.current, extensions: editable },
    });
    return () => merge.destroy();
  }, [path, theirs, isNarrow, t]);
  return <div ref={host} className={classes['merge']} />;
}
