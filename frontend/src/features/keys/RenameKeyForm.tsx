import { Button, Group, Select, Stack, Text, TextInput } from '@mantine/core';
import { useMemo, useState, type FormEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { allKeys, planRename, type Key } from '@/model/keys/rename';
import { scopeOf, SHARED, type Forest } from '@/model/keys/scope';
import { useProjectStore } from '@/store/project';
import { renameKey } from '@/store/project/edits/renameKey';
import { undoNotification } from '@/ui/undoNotification';
import { PlanView } from './PlanView';

interface RenameKeyFormProps {
  /** null: the user chooses the key. */
  readonly start: Key | null;
  readonly onDone: () => void;
}

const idOf = ({ board, name }: Key): string => `${board} ${name}`;

/** Returns the key in the project's list that is the same entry as a given key. */
function listed(keys: readonly Key[], start: Key | null, forest: Forest): Key | undefined {
  if (!start) return undefined;
  const scope = scopeOf(forest, start.board, start.name);
  return keys.find(({ board, name }) => name === start.name && scope.has(board)) ?? start;
}

/** The form with the old and the new name of a key, and the changes to be made. */
export function RenameKeyForm({ start, onDone }: RenameKeyFormProps) {
  const { t } = useTranslation('keys');
  const diagrams = useProjectStore((state) => state.diagrams);
  const mainTree = useProjectStore((state) => state.mainTree);
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const isReadOnly = useProjectStore((state) => state.role === 'viewer');
  const forest = useMemo(() => ({ diagrams, mainTree }), [diagrams, mainTree]);
  const keys = useMemo(() => allKeys(forest, vocabulary), [forest, vocabulary]);
  const [chosen, setChosen] = useState<Key | null>(() => listed(keys, start, forest) ?? null);
  const [to, setTo] = useState(chosen?.name ?? '');
  const plan = useMemo(
    () => (chosen ? planRename(forest, vocabulary, chosen, to.trim()) : null),
    [chosen, forest, vocabulary, to],
  );
  const isUntouched = to === '' || plan?.refusal === 'same';

  const submit = (event: FormEvent): void => {
    event.preventDefault();
    const undo = plan && renameKey(plan);
    if (!undo) return;
    onDone();
    undoNotification({
      message: t('done', { from: chosen?.name, to: to.trim() }),
      undoLabel: t('undo'),
      undo,
    });
  };
  const options = keys.map((key) => ({
    value: idOf(key),
    label: `${key.name} — ${key.board === SHARED ? t('shared') : key.board}`,
  }));
  return (
    <form onSubmit={submit}>
      <Stack gap="sm">
        <Select
          searchable
          label={t('key')}
          data-testid="rename-key-old"
          placeholder={keys.length === 0 ? t('none') : t('choose')}
          data={options}
          value={chosen && idOf(chosen)}
          onChange={(value) => {
            const next = keys.find((key) => idOf(key) === value) ?? null;
            setChosen(next);
            setTo(next?.name ?? '');
          }}
        />
        <TextInput
          label={t('newName')}
          data-testid="rename-key-new"
          data-autofocus={start ? true : undefined}
          value={to}
          disabled={!chosen || isReadOnly}
          description={isReadOnly ? t('readOnly') : undefined}
          error={plan?.refusal && !isUntouched ? t(`refusal.${plan.refusal}`, { name: to.trim() }) : null}
          onFocus={({ currentTarget }) => currentTarget.select()}
          onChange={({ currentTarget }) => setTo(currentTarget.value)}
        />
        {plan && chosen ? <PlanView plan={plan} name={chosen.name} forest={forest} /> : null}
        {plan?.changes.length === 0 && !isUntouched ? <Text size="sm">{t('nothing')}</Text> : null}
        <Group justify="flex-end">
          <Button variant="default" onClick={onDone}>
            {t('cancel')}
          </Button>
          <Button
            type="submit"
            data-testid="rename-key-submit"
            disabled={!plan || plan.refusal !== null || plan.changes.length === 0 || isReadOnly}
          >
            {t('rename')}
          </Button>
        </Group>
      </Stack>
    </form>
  );
}
