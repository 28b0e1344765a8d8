import { Button, Group, Modal, Stack, Text } from '@mantine/core';
import type { TFunction } from 'i18next';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { TextDifference } from '@/features/revisions/TextDifference';
import { useProjectStore } from '@/store/project';
import { differencesOf, placesOf, updateBehaviour, type Difference } from '@/store/project/library';
import { withTexts } from '@/store/saving/large';
import classes from './library.module.css';
import type { Offer } from './useReusables';

/** One file before and after the update. */
function FileDifference({ difference }: { readonly difference: Difference }) {
  const { t } = useTranslation('library');
  const { path, mine, theirs } = difference;
  const labels = { before: t('before', { path }), after: t('after', { path }) };
  return (
    <div>
      <Text size="sm" fw={600} mb={4}>
        {path}
      </Text>
      <div className={classes['difference']} data-testid={`difference-${path}`}>
        <TextDifference path={path} before={mine} after={theirs} labels={labels} />
      </div>
    </div>
  );
}

interface UpdateDialogProps {
  readonly offer: Offer;
  readonly onClose: () => void;
}

function titleOf(t: TFunction<'library'>, { id, version, project }: Offer): string {
  return project === null
    ? t('updateTitle', { name: id, version })
    : t('updateTitleOf', { name: id, project });
}

function isLoaded(offer: Offer): boolean {
  const { files } = useProjectStore.getState();
  return placesOf(offer).every((path) => files[path]?.kind !== 'large');
}

/** Shows the changes of an update before it is made. */
export function UpdateDialog({ offer, onClose }: UpdateDialogProps) {
  const { t } = useTranslation('library');
  const [differences, setDifferences] = useState<readonly Difference[] | null>(() =>
    isLoaded(offer) ? differencesOf(offer) : null,
  );
  const [failure, setFailure] = useState('');
  useEffect(() => {
    if (isLoaded(offer)) return;
    withTexts(placesOf(offer)).then(
      () => setDifferences(differencesOf(offer)),
      (error: Error) => setFailure(error.message),
    );
  }, [offer]);
  return (
    <Modal
      opened
      onClose={onClose}
      size="xl"
      title={titleOf(t, offer)}
      closeButtonProps={{ 'aria-label': t('cancel') }}
    >
      <Stack>
        {failure ? <Text role="alert">{failure}</Text> : null}
        {differences?.length === 0 ? <Text size="sm">{t('same')}</Text> : null}
        {differences?.map((difference) => (
          <FileDifference key={difference.path} difference={difference} />
        ))}
        <Group justify="flex-end">
          <Button variant="default" onClick={onClose}>
            {t('cancel')}
          </Button>
          <Button
            data-testid="confirm-update"
            disabled={differences === null}
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
