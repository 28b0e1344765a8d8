import { Button, Group, Modal, Text } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { Suspense, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import type { Conflict } from '@/api/types';
import { resolveConflict } from '@/store/saving/conflicts';
import { useSavingStore } from '@/store/saving/store';
import { lazyPart } from '@/ui/parts';
import { useIsNarrow } from '@/ui/hooks/useIsNarrow';
import classes from './code.module.css';

const MergeView = lazyPart(async () => (await import('./MergeView')).MergeView);

/**
 * A dialogue for a file that another user has also saved: it shows both versions, and lets the user choose
 * one or merge them.
 */
export function ConflictDialog() {
  const { t } = useTranslation('code');
  const conflict = useSavingStore(({ state }) =>
    state.kind === 'conflict' ? state.conflicts[0] : undefined,
  );
  const count = useSavingStore(({ state }) => (state.kind === 'conflict' ? state.conflicts.length : 0));
  if (!conflict) return null;
  return (
    <Modal
      opened
      size="80rem"
      withCloseButton={false}
      closeOnEscape={false}
      closeOnClickOutside={false}
      onClose={() => undefined}
      title={<Text fw={600}>{t('conflict.title', { path: conflict.path })}</Text>}
    >
      <Choice key={conflict.path} conflict={conflict} left={count - 1} />
    </Modal>
  );
}

function Choice({ conflict, left }: { readonly conflict: Conflict; readonly left: number }) {
  const { t } = useTranslation('code');
  const mine = conflict.mine.content;
  const theirs = conflict.theirs?.content ?? null;
  const merged = useRef(mine ?? '');
  const isNarrow = useIsNarrow();
  const choose = (text: string | null) => {
    resolveConflict(conflict, text).catch((error: Error) =>
      notifications.show({ color: 'red', title: t('conflict.failed'), message: error.message }),
    );
  };
  return (
    <>
      <Text size="sm" c="dimmed" mb="sm">
        {t(isNarrow ? 'conflict.textUnified' : 'conflict.text')}{' '}
        {left > 0 ? t('conflict.left', { count: left }) : null}
      </Text>
      {isNarrow ? null : (
        <div className={classes['mergeHeads']}>
          <span>{t('conflict.theirs')}</span>
          <span>{t('conflict.mine')}</span>
        </div>
      )}
      <Suspense fallback={<div className={classes['merge']} />}>
        <MergeView
          path={conflict.path}
          theirs={theirs ?? ''}
          mine={mine ?? ''}
          onChange={(text) => {
            merged.current = text;
          }}
        />
      </Suspense>
      <Group justify="flex-end" mt="md">
        <Button variant="default" data-testid="take-theirs" onClick={() => choose(theirs)}>
          {t('conflict.takeTheirs')}
        </Button>
        <Button variant="default" data-testid="keep-mine" onClick={() => choose(mine)}>
          {t('conflict.keepMine')}
        </Button>
        <Button data-autofocus data-testid="save-merge" onClick={() => choose(merged.current)}>
          {t(isNarrow ? 'conflict.saveUnified' : 'conflict.saveMerge')}
        </Button>
      </Group>
    </>
  );
}
