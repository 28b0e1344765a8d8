import { MergeView as CodeMirrorMerge } from '@codemirror/merge';
import { EditorState } from '@codemirror/state';
import { EditorView, lineNumbers } from '@codemirror/view';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import classes from './code.module.css';
import { editorTheme } from './editorTheme';
import { languageOf } from './modes';
import { phrases } from './phrases';

interface MergeViewProps {
  readonly path: string;
  readonly theirs: string;
  readonly mine: string;
  readonly onChange: (merged: string) => void;
}

/**
 * Both versions of a file: the server's on the left, and the user's on the right, which can be edited, with
 * arrows that copy pieces over.
 */
export function MergeView({ path, theirs, mine, onChange }: MergeViewProps) {
  const { t } = useTranslation('code');
  const host = useRef<HTMLDivElement>(null);
  const changed = useRef(onChange);
  useEffect(() => {
    changed.current = onChange;
  });
  useEffect(() => {
    if (!host.current) return;
    const shared = [lineNumbers(), languageOf(path), editorTheme, phrases()];
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
      b: {
        doc: mine,
        extensions: [
          shared,
          EditorView.contentAttributes.of({ 'aria-label': t('conflict.mine') }),
          EditorView.updateListener.of((update) => {
            if (update.docChanged) changed.current(update.state.doc.toString());
          }),
        ],
      },
    });
    return () => merge.destroy();
  }, [path, theirs, mine, t]);
  return <div ref={host} className={classes['merge']} />;
}
