import { Button, Group, Loader, Modal, Text } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { useQuery } from '@tanstack/react-query';
import { Suspense, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import type { Conflict } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { resolveConflict } from '@/store/saving/conflicts';
import { fetchText } from '@/store/saving/large';
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

/** Returns a conflict with the other version's text, which is loaded if it is large. */
function useWhole(conflict: Conflict) {
  const { path, theirs } = conflict;
  const projectId = useProjectStore((state) => state.projectId);
  const isLeftOut = theirs !== null && theirs.content === null;
  const { data, error, refetch } = useQuery({
    queryKey: ['conflict', projectId, path, theirs?.revision],
    queryFn: ({ signal }) => fetchText(path, signal),
    enabled: isLeftOut,
    retry: false,
  });
  if (!isLeftOut) return { whole: conflict, error: null, refetch };
  const whole = data && {
    ...conflict,
    theirs: { revision: data.revision || theirs.revision, content: data.text },
  };
  return { whole: whole ?? null, error, refetch };
}

const chooserOf = (conflict: Conflict, failed: string) => (text: string | null) => {
  resolveConflict(conflict, text).catch((error: Error) =>
    notifications.show({ color: 'red', title: failed, message: error.message }),
  );
};

function Choice({ conflict, left }: { readonly conflict: Conflict; readonly left: number }) {
  const { t } = useTranslation('code');
  const { whole, error, refetch } = useWhole(conflict);
  const choose = chooserOf(conflict, t('conflict.failed'));
  if (whole) return <Versions conflict={whole} left={left} />;
  if (!error)
    return <Loader size="sm" role="status" aria-label={t('large.loading', { path: conflict.path })} />;
  return (
    <Group>
      <Text role="alert">{t('large.failed', { path: conflict.path, reason: error.message })}</Text>
      <Button size="xs" variant="default" onClick={() => void refetch()}>
        {t('large.retry')}
      </Button>
      <Button
        size="xs"
        variant="default"
        data-testid="keep-mine"
        onClick={() => choose(conflict.mine.content)}
      >
        {t('conflict.keepMine')}
      </Button>
    </Group>
  );
}

function Versions({ conflict, left }: { readonly conflict: Conflict; readonly left: number }) {
  const { t } = useTranslation('code');
  const mine = conflict.mine.content;
  const theirs = conflict.theirs?.content ?? null;
  const merged = useRef(mine ?? '');
  const isNarrow = useIsNarrow();
  const choose = chooserOf(conflict, t('conflict.failed'));
  // A binary file has no text that could be taken.
  const isBinary = conflict.theirs !== null && theirs === null;
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
        {isBinary ? null : (
          <Button variant="default" data-testid="take-theirs" onClick={() => choose(theirs)}>
            {t('conflict.takeTheirs')}
          </Button>
        )}
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
