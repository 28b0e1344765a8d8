import { Button, SegmentedControl, Text } from '@mantine/core';
import { IconAlertTriangle } from '@tabler/icons-react';
import { Suspense, type ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import type { DocumentProblem } from '@/model/document/yaml';
import { lazyPart } from '@/ui/parts';
import classes from './editor3d.module.css';
import { ProblemList } from './ProblemList';
import type { Editor } from './editing';
import { useUndoInFront } from './useUndoInFront';

const CodeTab = lazyPart(async () => (await import('@/features/code/CodeTab')).CodeTab);

/** The texts for one kind of document. */
interface Words {
  readonly unreadable: string;
  readonly problems: string;
}

interface EditorFrameProps {
  readonly editor: Editor;
  readonly testId: string;
  /** The existing files of the document. */
  readonly paths: readonly string[];
  readonly problems: readonly DocumentProblem[];
  readonly words: Words;
  readonly toolbar: ReactNode;
  /** The view and the panel; null if the document cannot be shown. */
  readonly children: ReactNode;
}

/**
 * The frame of a 3D editor: the document in 3D with its text beside it, or only the text where 3D is not
 * available.
 */
export function EditorFrame({ editor, testId, paths, problems, words, toolbar, children }: EditorFrameProps) {
  const { t } = useTranslation('editor3d');
  const { isTextShown, shownText } = useStore(editor.store);
  useUndoInFront(editor);
  const path = paths[shownText] ?? paths[0] ?? editor.path;
  const list = <ProblemList problems={problems} paths={paths} title={words.problems} editor={editor} />;
  const text = (
    <div className={classes['text']}>
      {paths.length > 1 ? (
        <SegmentedControl
          fullWidth
          size="xs"
          radius={0}
          aria-label={t('whichText')}
          value={path}
          onChange={(value) => editor.store.setState({ shownText: Math.max(paths.indexOf(value), 0) })}
          data={paths.map((each) => ({ value: each, label: each.split('/').at(-1) ?? each }))}
        />
      ) : null}
      <div className={classes['code']}>
        <Suspense fallback={<Text p="sm">{t('loadingText')}</Text>}>
          <CodeTab key={path} path={path} />
        </Suspense>
      </div>
    </div>
  );
  if (paths.length === 0) {
    return (
      <div className={classes['tab']} tabIndex={-1} data-testid={`${testId}-text`}>
        {list}
        {text}
      </div>
    );
  }
  return (
    <div className={classes['tab']} tabIndex={-1} data-testid={testId} data-path={editor.path}>
      {toolbar}
      <div className={classes['work']} data-text={isTextShown || undefined}>
        <div className={classes['stage']}>
          {children ?? (
            <div className={classes['unreadable']} role="alert">
              <IconAlertTriangle size={28} aria-hidden="true" />
              <Text fw={600}>{words.unreadable}</Text>
              <Text size="sm" c="dimmed">
                {t('unreadableHint')}
              </Text>
              {isTextShown ? null : (
                <Button variant="light" onClick={() => editor.store.setState({ isTextShown: true })}>
                  {t('showText')}
                </Button>
              )}
            </div>
          )}
        </div>
        {isTextShown ? text : null}
      </div>
      {list}
    </div>
  );
}
