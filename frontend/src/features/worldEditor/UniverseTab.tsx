import { Alert, Button, Text } from '@mantine/core';
import { IconAlertTriangle, IconCube3dSphere } from '@tabler/icons-react';
import { lazy, Suspense, useEffect, useMemo, type ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { hasWebGl } from '@/features/viewer/webgl';
import { readUniverse } from '@/model/universe/read';
import { useProjectStore } from '@/store/project';
import { editorOf, followText } from './editor';
import { EditorPanel } from './EditorPanel';
import { EditorToolbar } from './EditorToolbar';
import { EditorView } from './EditorView';
import { ProblemList } from './ProblemList';
import classes from './worldEditor.module.css';

const CodeTab = lazy(async () => ({ default: (await import('@/features/code/CodeTab')).CodeTab }));

/** A universe of the project: seen and changed in 3D, with its text beside. */
export function UniverseTab({ path }: { readonly path: string }) {
  const { t } = useTranslation('worldEditor');
  const editor = useMemo(() => editorOf(path), [path]);
  const text = useProjectStore((state) => state.currentText(path));
  const { universe, problems } = useMemo(() => readUniverse(text ?? ''), [text]);
  const isTextShown = useStore(editor.store, (state) => state.isTextShown);

  useEffect(() => {
    if (text !== null) followText(editor, text);
  }, [editor, text]);

  const code: ReactNode = (
    <Suspense fallback={<Text p="sm">{t('loadingText')}</Text>}>
      <CodeTab path={path} />
    </Suspense>
  );
  if (text === null || !hasWebGl()) {
    return (
      <div className={classes['tab']}>
        {text === null ? null : (
          <Alert icon={<IconCube3dSphere size={18} />} color="gray" radius={0} py="xs">
            {t('noWebGl')}
          </Alert>
        )}
        <ProblemList problems={problems} path={path} />
        <div className={classes['text']}>{code}</div>
      </div>
    );
  }
  return (
    <div className={classes['tab']} data-testid="universe-editor" data-path={path}>
      <EditorToolbar editor={editor} />
      <div className={classes['work']} data-text={isTextShown || undefined}>
        <div className={classes['stage']}>
          {universe ? (
            <>
              <EditorView editor={editor} universe={universe} />
              <EditorPanel editor={editor} universe={universe} />
            </>
          ) : (
            <div className={classes['unreadable']} role="alert">
              <IconAlertTriangle size={28} aria-hidden="true" />
              <Text fw={600}>{t('unreadable')}</Text>
              <Text size="sm" c="dimmed">
                {t('unreadableHint')}
              </Text>
              {isTextShown ? null : (
                <Button
                  variant="light"
                  onClick={() => {
                    editor.store.setState({ isTextShown: true });
                  }}
                >
                  {t('showText')}
                </Button>
              )}
            </div>
          )}
        </div>
        {isTextShown ? <div className={classes['text']}>{code}</div> : null}
      </div>
      <ProblemList problems={problems} path={path} editor={editor} />
    </div>
  );
}
