import { MergeView, unifiedMergeView } from '@codemirror/merge';
import { EditorState } from '@codemirror/state';
import { EditorView, lineNumbers } from '@codemirror/view';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { editorTheme } from '@/features/code/editorTheme';
import { languageOf } from '@/features/code/modes';
import { phrases } from '@/features/code/phrases';
import { useIsNarrow } from '@/ui/hooks/useIsNarrow';
import { dimMetadata } from '@/features/xml/ranges';
import classes from './revisions.module.css';

interface TextDifferenceProps {
  /** The path of the file, which determines the syntax colours. */
  readonly path: string;
  readonly before: string;
  readonly after: string;
  /** The names of the two texts for screen readers, if they are not revisions. */
  readonly labels?: { readonly before: string; readonly after: string };
}

const COLLAPSE = { margin: 3, minSize: 6 };

/** Two texts side by side; one below the other in narrow windows. */
export function TextDifference({ path, before, after, labels }: TextDifferenceProps) {
  const { t } = useTranslation('revisions');
  const host = useRef<HTMLDivElement>(null);
  const isNarrow = useIsNarrow();
  const beforeLabel = labels?.before ?? t('before');
  const afterLabel = labels?.after ?? t('after');
  useEffect(() => {
    if (!host.current) return;
    const shared = (label: string) => [
      lineNumbers(),
      languageOf(path),
      path.endsWith('.xml') ? dimMetadata : [],
      editorTheme,
      phrases(),
      EditorView.lineWrapping,
      EditorState.readOnly.of(true),
      EditorView.contentAttributes.of({ 'aria-label': label }),
    ];
    if (isNarrow) {
      const unified = unifiedMergeView({
        original: before,
        mergeControls: false,
        collapseUnchanged: COLLAPSE,
      });
      const state = EditorState.create({ doc: after, extensions: [shared(afterLabel), unified] });
      const view = new EditorView({ parent: host.current, state });
      return () => view.destroy();
    }
    const merge = new MergeView({
      parent: host.current,
      a: { doc: before, extensions: shared(beforeLabel) },
      b: { doc: after, extensions: shared(afterLabel) },
      collapseUnchanged: COLLAPSE,
    });
    return () => merge.destroy();
  }, [path, before, after, isNarrow, beforeLabel, afterLabel]);
  return <div ref={host} className={classes['text']} data-testid="text-difference" />;
}
