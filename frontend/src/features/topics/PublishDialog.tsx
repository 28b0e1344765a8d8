import { Alert, Autocomplete, Button, Group, JsonInput, Modal, Stack, Text, Tooltip } from '@mantine/core';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { reasonOf } from '@/api/reason';
import { useIsBack } from '@/store/moment/store';
import { describeType, publish } from '@/store/run/topics';
import { CommandError } from '@/store/session/control';
import { useTopicsStore } from '@/store/session/topics';
import { PausedWorld } from '@/ui/PausedWorld';
import { closePublish, usePublishing } from './publishing';

const DESCRIBE_AFTER_MS = 250;

/** A dialogue that publishes a message on a topic; its fields start with the defaults of the type. */
export function PublishDialog() {
  const { t } = useTranslation('topics');
  const opened = usePublishing((state) => state.opened);
  return (
    <Modal opened={opened !== null} onClose={closePublish} title={t('publishTitle')} size="lg">
      {opened ? <PublishForm {...opened} /> : null}
    </Modal>
  );
}

interface PublishFormProps {
  readonly topic: string;
  readonly type: string;
}

function PublishForm({ topic: firstTopic, type: firstType }: PublishFormProps) {
  const { t } = useTranslation('topics');
  const topics = useTopicsStore((state) => state.topics);
  const [topic, setTopic] = useState(firstTopic);
  const [type, setType] = useState(firstType);
  const description = useTopicsStore((state) => state.descriptions[type]);
  const [typed, setTyped] = useState<string | null>(null);
  const [result, setResult] = useState<{ isError: boolean; text: string } | null>(null);
  const unknown = useDescription(type);
  const text = typed ?? (description ? JSON.stringify(description.example, null, 2) : '{}');

  const chooseTopic = (name: string) => {
    setTopic(name);
    const known = topics.find((row) => row.name === name);
    if (!known || known.types.includes(type)) return;
    setType(known.type);
    setTyped(null);
  };

  // Only a message that the user sees can be sent: not before the type's fields are shown.
  const canSend = topic.trim() !== '' && type.trim() !== '' && (typed !== null || description !== undefined);
  const isBack = useIsBack();
  const submit = async () => {
    if (!canSend) return;
    try {
      const message: unknown = JSON.parse(text);
      if (typeof message !== 'object' || message === null || Array.isArray(message)) {
        throw new Error(t('noObject'));
      }
      await publish(topic.trim(), type.trim(), message as Record<string, unknown>);
      setResult({ isError: false, text: t('published', { topic: topic.trim() }) });
    } catch (error) {
      // The field already shows the error.
      if (error instanceof SyntaxError) return setResult(null);
      // The notice above already says that the world is paused, and how to resume it.
      if (error instanceof CommandError && error.code === 'world_paused') return setResult(null);
      setResult({ isError: true, text: reasonOf(error as Error) });
    }
  };

  return (
    // The form handles the keys of its fields, wherever the caret is.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions
    <form
      data-testid="publish"
      // Enter in a field chooses a topic or a type, so it must not send the form.
      onSubmit={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (event.key !== 'Enter' || !(event.ctrlKey || event.metaKey)) return;
        event.preventDefault();
        void submit();
      }}
    >
      <Stack gap="sm">
        <Group grow align="start">
          <Autocomplete
            label={t('name')}
            placeholder="/cmd_vel"
            data={topics.map((row) => row.name)}
            value={topic}
            required
            data-autofocus
            onChange={chooseTopic}
          />
          <Autocomplete
            label={t('type')}
            placeholder="geometry_msgs/msg/Twist"
            data={[...new Set(topics.flatMap((row) => [row.type, ...row.types]))].sort()}
            value={type}
            required
            error={unknown}
            onChange={(value) => {
              setType(value);
              setTyped(null);
            }}
          />
        </Group>
        <JsonInput
          label={t('message')}
          description={t('messageHelp')}
          value={text}
          formatOnBlur
          autosize
          minRows={6}
          maxRows={16}
          validationError={t('notJson')}
          styles={{ input: { fontFamily: 'var(--bts-font-mono)', fontSize: 12.5 } }}
          onChange={setTyped}
        />
        {description ? (
          <Text size="xs" c="dimmed">
            {Object.entries(description.fields)
              .map(([name, of]) => `${name}: ${of}`)
              .join(' · ')}
          </Text>
        ) : null}
        <PausedWorld text={t('worldPaused')} />
        {result ? (
          <Alert color={result.isError ? 'red' : 'teal'} role="status" py={8}>
            {result.text}
          </Alert>
        ) : null}
        <Group justify="end">
          <Button variant="default" onClick={closePublish}>
            {t('close')}
          </Button>
          <Tooltip label={t('publishKeys')}>
            <Button disabled={!canSend || isBack} onClick={() => void submit()}>
              {t('publishOnce')}
            </Button>
          </Tooltip>
        </Group>
      </Stack>
    </form>
  );
}

/**
 * Requests the fields of a type after the user has typed it; returns the reason if the type has no
 * description.
 */
function useDescription(type: string): string | null {
  const isKnown = useTopicsStore((state) => type in state.descriptions);
  const [refusal, setRefusal] = useState<{ type: string; text: string } | null>(null);
  useEffect(() => {
    if (isKnown || !/^\w+\/msg\/\w+$/.test(type)) return;
    const timer = setTimeout(() => {
      describeType(type).catch((error: Error) => setRefusal({ type, text: reasonOf(error) }));
    }, DESCRIBE_AFTER_MS);
    return () => clearTimeout(timer);
  }, [type, isKnown]);
  return refusal?.type === type ? refusal.text : null;
}
