import { Button, Group, Stack, Switch, Text, TextInput } from '@mantine/core';
import { useEffect, useRef, useState, type FormEvent } from 'react';
import { useTranslation } from 'react-i18next';
import type { UniverseInfo } from '@/api/types';
import { ChoiceCards } from '@/features/universe/ChoiceCards';
import { freeName } from '@/features/universe/freeNames';
import universe from '@/features/universe/universe.module.css';

const ID = /^[A-Za-z_][A-Za-z0-9_-]*$/;

/** The texts for one kind of document. */
interface Words {
  readonly hint: string;
  readonly taken: string;
  readonly use: string;
}

interface CopyFormProps {
  readonly items: readonly UniverseInfo[];
  /** The initial choice, shown first so that it is visible without scrolling. */
  readonly first: string;
  /** The ids in use, in lower case. */
  readonly taken: ReadonlySet<string>;
  readonly words: Words;
  readonly testId: string;
  /** Creates the document. If it throws, the form shows the message. */
  readonly onCreate: (base: string, name: string, isUsed: boolean) => Promise<void>;
  readonly onCancel: () => void;
}

/** Copies one of our universes or robots into the project. */
export function CopyForm({ items, first, taken, words, testId, onCreate, onCancel }: CopyFormProps) {
  const { t } = useTranslation('editor3d');
  const [base, setBase] = useState(first);
  const [name, setName] = useState<string | null>(null);
  const [isUsed, setUsed] = useState(true);
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    // When the content arrives late, the first button of the dialogue already has the focus.
    const timer = setTimeout(() => field.current?.focus());
    return () => clearTimeout(timer);
  }, []);
  const [state, setState] = useState<{ isBusy: boolean; error: string | null }>({
    isBusy: false,
    error: null,
  });
  const shown = name ?? freeName(`my_${base === 'template' ? 'robot' : base}`, taken);
  const ordered = [...items].sort((a, b) => Number(b.id === first) - Number(a.id === first));
  const problem = !ID.test(shown) ? t('problem.name') : taken.has(shown.toLowerCase()) ? words.taken : null;

  const submit = (event: FormEvent) => {
    event.preventDefault();
    if (problem || state.isBusy) return;
    setState({ isBusy: true, error: null });
    onCreate(base, shown, isUsed).catch((error: Error) => setState({ isBusy: false, error: error.message }));
  };

  return (
    <form onSubmit={submit}>
      <Stack gap="md" data-testid={`${testId}-form`}>
        <Text size="sm">{words.hint}</Text>
        <ChoiceCards label={t('copy.base')} items={ordered} chosen={base} onChoose={setBase} />
        <Stack gap="sm" className={universe['decision'] ?? ''}>
          <TextInput
            data-autofocus
            ref={field}
            label={t('copy.name')}
            data-testid={`${testId}-name`}
            value={shown}
            error={problem}
            onChange={(event) => setName(event.currentTarget.value)}
          />
          <Switch
            label={words.use}
            checked={isUsed}
            onChange={(event) => setUsed(event.currentTarget.checked)}
          />
          {state.error ? (
            <Text size="sm" c="var(--bts-failure)" role="alert">
              {state.error}
            </Text>
          ) : null}
          <Group justify="flex-end">
            <Button variant="default" onClick={onCancel}>
              {t('copy.cancel')}
            </Button>
            <Button
              type="submit"
              loading={state.isBusy}
              disabled={problem !== null}
              data-testid={`${testId}-ok`}
            >
              {t('copy.create')}
            </Button>
          </Group>
        </Stack>
      </Stack>
    </form>
  );
}
