import { Button, Group, NativeSelect, TextInput } from '@mantine/core';
import { IconDeviceFloppy } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { RunToKeep } from '@/api/runs';
import { labelOf } from '@/store/moment/compare/runNames';
import { runsOf } from '@/store/recording/liveSource';
import { useSessionStore } from '@/store/session/store';
import { runToKeep } from './runToKeep';

/** A form that keeps the run of the session, with a name and a note. */
export function KeepForm({ onKeep }: { readonly onKeep: (run: RunToKeep) => Promise<boolean> }) {
  const { t, i18n } = useTranslation('runs');
  const segments = useSessionStore((state) => state.segments);
  const branches = useSessionStore((state) => state.branches);
  const runs = useMemo(() => runsOf(segments), [segments]);
  const [chosen, setChosen] = useState(() => runToKeep(runs));
  // A run whose recording is gone meanwhile is not kept.
  const run = runs.find((each) => each === chosen) ?? runs.at(-1);
  const [name, setName] = useState(() => new Date().toLocaleString(i18n.language));
  const [note, setNote] = useState('');
  const [isKeeping, setKeeping] = useState(false);
  if (run === undefined) return null;
  const keep = async () => {
    setKeeping(true);
    if (await onKeep({ run, name: name.trim(), note: note.trim() })) setNote('');
    setKeeping(false);
  };
  return (
    <form
      aria-label={t('keepTitle')}
      onSubmit={(event) => {
        event.preventDefault();
        void keep();
      }}
    >
      <Group align="end" gap="xs" mb="md">
        {runs.length > 1 ? (
          <NativeSelect
            label={t('which')}
            value={run}
            data={runs.map((value) => ({ value, label: labelOf(value, { segments, branches }) })).reverse()}
            onChange={({ currentTarget: { value } }) => setChosen(value)}
            data-testid="run-to-keep"
          />
        ) : null}
        <TextInput
          label={t('name')}
          maxLength={100}
          required
          value={name}
          onChange={(event) => setName(event.currentTarget.value)}
          style={{ flex: '1 1 12rem' }}
          data-autofocus
        />
        <TextInput
          label={t('note')}
          maxLength={2000}
          placeholder={t('noteExample')}
          value={note}
          onChange={(event) => setNote(event.currentTarget.value)}
          style={{ flex: '2 1 14rem' }}
        />
        <Button
          type="submit"
          loading={isKeeping}
          disabled={name.trim() === ''}
          leftSection={<IconDeviceFloppy size={16} />}
          data-testid="keep-run"
        >
          {t('keep')}
        </Button>
      </Group>
    </form>
  );
}
