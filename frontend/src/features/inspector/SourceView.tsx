import { EditorState } from '@codemirror/state';
import { EditorView, lineNumbers } from '@codemirror/view';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { editorTheme } from '@/features/code/editorTheme';
import { languageOf } from '@/features/code/modes';

interface SourceViewProps {
  readonly path: string;
  readonly text: string;
}

/** The text of a file with syntax colours; it is read-only. */
export function SourceView({ path, text }: SourceViewProps) {
  const { t } = useTranslation('inspector');
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!host.current) return;
    const view = new EditorView({
      parent: host.current,
      state: EditorState.create({
        doc: text,
        extensions: [
          lineNumbers(),
          languageOf(path),
          editorTheme,
          EditorState.readOnly.of(true),
          EditorView.editable.of(false),
          EditorView.contentAttributes.of({ 'aria-label': t('sourceOf', { path }), tabindex: '0' }),
        ],
      }),
    });
    return () => view.destroy();
  }, [path, text, t]);
  return <div ref={host} data-testid="action-source" />;
}
