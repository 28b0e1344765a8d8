import { MergeView } from '@codemirror/merge';
import { EditorState } from '@codemirror/state';
import { EditorView, lineNumbers } from '@codemirror/view';
import { Button, Group, Modal, Stack, Text } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { editorTheme } from '@/features/code/editorTheme';
import { languageOf } from '@/features/code/modes';
import { phrases } from '@/features/code/phrases';
import { differencesOf, updateBehaviour, type Difference } from '@/store/project/library';
import classes from './library.module.css';
import type { Offer } from './useReusables';

/** One file before and after the update, side by side. */
function FileDifference({ difference }: { readonly difference: Difference }) {
  const { t } = useTranslation('library');
  const host = useRef<HTMLDivElement>(null);
  const { path, mine, theirs } = difference;
  useEffect(() => {
    if (!host.current) return;
    const side = (doc: string, label: string) => ({
      doc,
      extensions: [
        lineNumbers(),
        languageOf(path),
        editorTheme,
        phrases(),
        EditorState.readOnly.of(true),
        EditorView.lineWrapping,
        EditorView.contentAttributes.of({ 'aria-label': label }),
      ],
    });
    const view = new MergeView({
      parent: host.current,
      a: side(mine, t('before', { path })),
      b: side(theirs, t('after', { path })),
      collapseUnchanged: {},
    });
    return () => view.destroy();
  }, [path, mine, theirs, t]);
  return (
    <div>
      <Text size="sm" fw={600} mb={4}>
        {path}
      </Text>
      <div ref={host} className={classes['difference']} data-testid={`difference-${path}`} />
    </div>
  );
}

interface UpdateDialogProps {
  readonly offer: Offer;
  readonly onClose: () => void;
}

/** A dialogue with the changes of an update before it is made. */
export function UpdateDialog({ offer, onClose }: UpdateDialogProps) {
  const { t } = useTranslation('library');
  const [differences] = useState(() => differencesOf(offer));
  return (
    <Modal
      opened
      onClose={onClose}
      size="xl"
      title={t('updateTitle', { name: offer.id, version: offer.version })}
      closeButtonProps={{ 'aria-label': t('cancel') }}
    >
      <Stack>
        {differences.length === 0 ? <Text size="sm">{t('same')}</Text> : null}
        {differences.map((difference) => (
          <FileDifference key={difference.path} difference={difference} />
        ))}
        <Group justify="flex-end">
          <Button variant="default" onClick={onClose}>
            {t('cancel')}
          </Button>
          <Button
            data-testid="confirm-update"
            onClick={() => {
              updateBehaviour(offer);
              onClose();
            }}
          >
            {t('update')}
          </Button>
        </Group>
      </Stack>
    </Modal>
  );
}
