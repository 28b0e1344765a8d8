import { Button, Group, Loader, Modal, Stack, Switch, Text, TextInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useState, type FormEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { ChoiceCards } from '@/features/universe/ChoiceCards';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { closeNewUniverse, useNewUniverse } from './newUniverse';

const ID = /^[A-Za-z_][A-Za-z0-9_-]*$/;

/** Makes a universe of the project out of one that we ship. */
export function NewUniverse() {
  const { t } = useTranslation('worldEditor');
  const base = useNewUniverse((state) => state.base);
  return (
    <Modal
      opened={base !== null}
      onClose={closeNewUniverse}
      title={t('new.title')}
      size={760}
      closeButtonProps={{ 'aria-label': t('new.cancel') }}
    >
      {base !== null ? <Form first={base} /> : null}
    </Modal>
  );
}

function freeName(wish: string, taken: ReadonlySet<string>): string {
  for (let count = 1; ; count += 1) {
    const name = count === 1 ? wish : `${wish}_${count}`;
    if (!taken.has(name.toLowerCase())) return name;
  }
}

function Form({ first }: { readonly first: string }) {
  const { t } = useTranslation('worldEditor');
  const files = useProjectStore((state) => state.files);
  const universes = useQuery({ queryKey: ['universes'], queryFn: api.universes, staleTime: Infinity });
  const taken = new Set(
    [...Object.keys(files)].map((path) => /^universes\/([^/]+)\.yaml$/.exec(path)?.[1]?.toLowerCase() ?? ''),
  );
  const [base, setBase] = useState(first);
  const [name, setName] = useState<string | null>(null);
  const [isUsed, setUsed] = useState(true);
  const [state, setState] = useState<{ isBusy: boolean; error: string | null }>({
    isBusy: false,
    error: null,
  });
  const shown = name ?? freeName(`my_${base}`, taken);
  const problem = !ID.test(shown)
    ? t('editor3d:problem.name')
    : taken.has(shown.toLowerCase())
      ? t('new.taken')
      : null;

  const submit = (event: FormEvent) => {
    event.preventDefault();
    if (problem || state.isBusy) return;
    setState({ isBusy: true, error: null });
    api.universeText(base).then(
      (text) => {
        const project = useProjectStore.getState();
        const path = `universes/${shown}.yaml`;
        project.addFile(path, text);
        if (isUsed) project.setSettings({ universe: shown });
        closeNewUniverse();
        openFile(path);
      },
      (error: Error) => setState({ isBusy: false, error: error.message }),
    );
  };

  if (universes.isPending) return <Loader size="sm" aria-label={t('new.loading')} />;
  return (
    <form onSubmit={submit}>
      <Stack gap="md" data-testid="new-universe-form">
        <Text size="sm">{t('new.hint')}</Text>
        <ChoiceCards label={t('new.base')} items={universes.data ?? []} chosen={base} onChoose={setBase} />
        <TextInput
          data-autofocus
          label={t('new.name')}
          data-testid="new-universe-name"
          value={shown}
          error={problem}
          onChange={(event) => setName(event.currentTarget.value)}
        />
        <Switch
          label={t('new.use')}
          checked={isUsed}
          onChange={(event) => setUsed(event.currentTarget.checked)}
        />
        {state.error ? (
          <Text size="sm" c="var(--bts-failure)" role="alert">
            {state.error}
          </Text>
        ) : null}
        <Group justify="flex-end">
          <Button variant="default" onClick={closeNewUniverse}>
            {t('new.cancel')}
          </Button>
          <Button
            type="submit"
            loading={state.isBusy}
            disabled={problem !== null}
            data-testid="new-universe-ok"
          >
            {t('new.create')}
          </Button>
        </Group>
      </Stack>
    </form>
  );
}
