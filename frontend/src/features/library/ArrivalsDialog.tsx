import { Button, Group, Modal, Stack, Text } from '@mantine/core';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { Choice } from '@/model/reuse';
import { closeArrivals, useArrivals, type Arrivals } from '@/store/dialogs/arrivals';
import { planHere } from '@/store/project/bringing';
import { useProjectStore } from '@/store/project';
import { ArrivalRow } from './ArrivalRow';
import classes from './library.module.css';

/** Shows the trees and actions that come with pasted blocks or a behaviour, before they are added. */
export function ArrivalsDialog() {
  const { t } = useTranslation('library');
  const arrivals = useArrivals((state) => state.arrivals);
  return (
    <Modal
      opened={arrivals !== null}
      onClose={closeArrivals}
      size="xl"
      title={arrivals ? t(`arrivals.${arrivals.act}.title`, { name: arrivals.name }) : null}
      closeButtonProps={{ 'aria-label': t('cancel') }}
      data-testid="arrivals"
    >
      {arrivals ? <Contents arrivals={arrivals} /> : null}
    </Modal>
  );
}

const GROUPS = [
  ['trees', /^trees\//],
  ['actions', /^actions\//],
] as const;

function Contents({ arrivals }: { readonly arrivals: Arrivals }) {
  const { t } = useTranslation('library');
  const [choices, setChoices] = useState<Readonly<Record<string, Choice>>>({});
  // The project may change while the dialogue is open, by another user.
  const files = useProjectStore((state) => state.files);
  const diagrams = useProjectStore((state) => state.diagrams);
  const plan = useMemo(
    () => planHere(arrivals, choices),
    // eslint-disable-next-line react-hooks/exhaustive-deps -- planHere reads them from the store
    [arrivals, choices, files, diagrams],
  );
  const { act, name, sources, take } = arrivals;
  return (
    <Stack gap="sm">
      <Text size="sm">{t(`arrivals.${act}.text`, { name })}</Text>
      {GROUPS.map(([group, pattern]) => {
        const shown = plan.arrivals.filter(({ path }) => pattern.test(path));
        if (shown.length === 0) return null;
        return (
          <section key={group} aria-labelledby={`arrivals-${group}`}>
            <h3 id={`arrivals-${group}`} className={classes['group']}>
              {t(`arrivals.${group}`, { count: shown.length })}
            </h3>
            <ul className={classes['arrivals']}>
              {shown.map((arrival) => (
                <ArrivalRow
                  key={arrival.path}
                  arrival={arrival}
                  source={sources[arrival.path] ?? ''}
                  onChoose={(choice) => setChoices({ ...choices, [arrival.path]: choice })}
                />
              ))}
            </ul>
          </section>
        );
      })}
      <Group justify="flex-end">
        <Button variant="default" onClick={closeArrivals}>
          {t('cancel')}
        </Button>
        <Button
          data-autofocus
          data-testid="take-arrivals"
          onClick={() => {
            closeArrivals();
            take(plan);
          }}
        >
          {t(`arrivals.${act}.button`)}
        </Button>
      </Group>
    </Stack>
  );
}
