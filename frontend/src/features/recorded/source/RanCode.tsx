import { python } from '@codemirror/lang-python';
import { EditorState, Text } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { useEffect, useMemo, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import type { SourceCall, TickSource } from '@/generated/messages';
import { basics } from '@/features/code/basics';
import { applyKeptFontSize } from '@/features/code/fontSize';
import { lineMarks, ranLines } from './marks';
import classes from './source.module.css';

interface RanCodeProps {
  readonly source: TickSource;
  readonly call: SourceCall;
}

/** The file of a call as it ran, read-only, with the lines that the tick ran. */
export function RanCode({ source, call }: RanCodeProps) {
  const { t } = useTranslation('axis');
  const host = useRef<HTMLDivElement>(null);
  const text = source.files[call.file];
  const label = t('source.editor', { file: call.file });
  const marks = useMemo(() => lineMarks(source.calls, call), [source, call]);

  useEffect(() => {
    if (!host.current || text === undefined) return;
    applyKeptFontSize();
    const doc = Text.of(text.split(/\r\n?|\n/));
    const editor = new EditorView({
      parent: host.current,
      state: EditorState.create({
        doc,
        extensions: [EditorState.readOnly.of(true), ranLines(doc, marks), basics(label), python()],
      }),
      scrollTo: EditorView.scrollIntoView(doc.line(Math.min(Math.max(call.line, 1), doc.lines)).from, {
        y: 'start',
        yMargin: 30,
      }),
    });
    return () => editor.destroy();
  }, [text, label, marks, call.line]);

  if (text === undefined) return <p className={classes['note']}>{t('source.noText', { file: call.file })}</p>;
  return <div ref={host} className={classes['editor']} data-testid="ran-code" />;
}
