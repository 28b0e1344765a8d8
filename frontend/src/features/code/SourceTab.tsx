import { highlightSelectionMatches } from '@codemirror/search';
import { python } from '@codemirror/lang-python';
import { EditorState } from '@codemirror/state';
import { EditorView, highlightActiveLineGutter } from '@codemirror/view';
import { Center, Loader, Text } from '@mantine/core';
import { IconLock } from '@tabler/icons-react';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useLanguageStore } from '@/store/language';
import { basics } from './basics';
import classes from './code.module.css';
import frame from './editorFrame.module.css';
import { applyKeptFontSize } from './fontSize';
import { readSource, sourceSupport, wakeLanguage } from './language/client';
import { reasonOf } from './language/reason';
import { sourceName } from './language/uris';
import { ReferencesPanel } from './places/ReferencesPanel';

interface SourceTabProps {
  /** The label of the source's folder, followed by the path below that folder. */
  readonly path: string;
}

/**
 * Shows Python source outside of the project, read-only; hover, definition and references still work in it.
 */
export function SourceTab({ path }: SourceTabProps) {
  const { t } = useTranslation('code');
  const { text, problem } = useSource(path);
  const host = useRef<HTMLDivElement>(null);
  const view = useRef<EditorView | null>(null);
  const name = sourceName(path);
  const label = t('source.label', { name });

  useEffect(() => {
    if (!host.current || text === null) return;
    applyKeptFontSize();
    const extensions = [
      EditorState.readOnly.of(true),
      basics(label),
      highlightActiveLineGutter(),
      highlightSelectionMatches(),
      python(),
      sourceSupport(path),
    ];
    const editor = new EditorView({
      parent: host.current,
      state: EditorState.create({ doc: text, extensions }),
    });
    view.current = editor;
    return () => {
      view.current = null;
      editor.destroy();
    };
  }, [path, label, text]);

  return (
    <div className={frame['frame']} data-testid="source-tab" data-path={path}>
      <div className={classes['readOnly']} role="note">
        <IconLock size={14} aria-hidden="true" />
        <strong>{name}</strong>
        <span>{t('source.readOnly')}</span>
      </div>
      {text === null ? (
        <Center flex={1}>
          {problem === null ? (
            <>
              <Loader size="sm" mr={8} role="none" />
              <Text role="status">{t('source.reading', { name })}</Text>
            </>
          ) : (
            <Text role="alert">{t('source.failed', { name, reason: problem })}</Text>
          )}
        </Center>
      ) : (
        <div ref={host} className={frame['editor']} data-testid="source-editor" />
      )}
      <ReferencesPanel onLeave={() => view.current?.focus()} />
    </div>
  );
}

/** Returns the text of a source, which is read once, when the language server runs. */
function useSource(path: string): { text: string | null; problem: string | null } {
  const state = useLanguageStore((store) => store.state);
  const [text, setText] = useState<string | null>(null);
  const [refused, setRefused] = useState<string | null>(null);
  const isReady = state.kind === 'ready';
  useEffect(wakeLanguage, []);
  useEffect(() => {
    if (!isReady || text !== null) return;
    let isCurrent = true;
    readSource(path).then(
      (read) => {
        if (isCurrent) setText(read);
      },
      (error: unknown) => {
        if (isCurrent) setRefused(reasonOf(error));
      },
    );
    return () => {
      isCurrent = false;
    };
  }, [path, isReady, text]);
  const isGivenUp = state.kind === 'failed' && !state.willRetry;
  return { text, problem: refused ?? (isGivenUp ? state.reason : null) };
}
