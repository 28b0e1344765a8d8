import { Button, Group, Modal, NativeSelect, Progress, Stack, Text } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { closeTries, stopTries, useTryMany, type TriedBlock } from '@/store/moment/rerun/tryMany';
import { useTries } from '@/store/session/tries';
import { useBlockNames } from './blockNames';
import { SeedsForm } from './SeedsForm';
import { TryResults } from './TryResults';
import { ValuesForm } from './ValuesForm';

/** The dialog of *Try many*: the values, how far it is, and what came of each. */
export function TryDialog() {
  const { t } = useTranslation('axis');
  const asking = useTryMany((state) => state.asking);
  return (
    <Modal
      opened={asking !== null}
      onClose={closeTries}
      size="min(1100px, 100%)"
      title={t('tries.title', { t: asking?.t.toFixed(2) })}
      centered
    >
      {asking ? (
        <Stack gap="sm" data-testid="tries">
          <Text size="sm">{t('tries.help')}</Text>
          <Asked key={`${asking.run} ${asking.t}`} {...asking} />
          <Going />
          <TryResults />
        </Stack>
      ) : null}
    </Modal>
  );
}

interface AskedProps {
  readonly run: string;
  readonly t: number;
  readonly blocks: readonly TriedBlock[];
  readonly uid: number | null;
}

/** The choice between values and seeds, and the form for them. */
function Asked(props: AskedProps) {
  const { t } = useTranslation('axis');
  const [what, setWhat] = useState('values');
  return (
    <>
      <NativeSelect
        size="xs"
        w={220}
        label={t('tries.what')}
        value={what}
        data={[
          { value: 'values', label: t('tries.whatValues') },
          { value: 'seeds', label: t('tries.whatSeeds') },
        ]}
        onChange={({ currentTarget }) => setWhat(currentTarget.value)}
        data-testid="tries-what"
      />
      {what === 'seeds' ? <SeedsForm moment={{ run: props.run, t: props.t }} /> : <PortAsked {...props} />}
    </>
  );
}

/** Block and port, and the form for the values of this port. */
function PortAsked({ run, t: moment, blocks, uid }: AskedProps) {
  const { t } = useTranslation('axis');
  const nameOf = useBlockNames();
  const [chosen, setChosen] = useState(uid);
  const [name, setName] = useState('');
  const block = blocks.find((each) => each.uid === chosen);
  const port = block?.ports.find((each) => each.name === name) ?? block?.ports[0];
  if (!block || !port) {
    return (
      <Text size="sm" role="status">
        {t('tries.noBlocks')}
      </Text>
    );
  }
  const value = block.values[port.name] ?? port.default;
  return (
    <>
      <Group gap="sm" align="end">
        <NativeSelect
          size="xs"
          maw="100%"
          label={t('tries.block')}
          value={String(block.uid)}
          data={blocks.map((each) => ({ value: String(each.uid), label: nameOf(each.path) }))}
          onChange={({ currentTarget }) => setChosen(Number(currentTarget.value))}
          data-autofocus
          data-testid="tries-block"
        />
        <NativeSelect
          size="xs"
          label={t('tries.port')}
          value={port.name}
          data={block.ports.map((each) => each.name)}
          onChange={({ currentTarget }) => setName(currentTarget.value)}
          data-testid="tries-port"
        />
        <Text size="sm" c="dimmed">
          {value === null ? t('tries.unset') : t('tries.now', { value })}
        </Text>
      </Group>
      <ValuesForm
        key={`${block.uid} ${port.name}`}
        port={port}
        value={value}
        place={{
          run,
          t: moment,
          treeId: block.treeId,
          nodeId: block.nodeId,
          path: block.path,
          port: port.name,
        }}
      />
    </>
  );
}

/** How far the job is, with a button that ends it; and why it ended early. */
function Going() {
  const { t } = useTranslation('axis');
  const job = useTries((state) => state.job);
  if (job === null || job.ended?.end === 'complete') return null;
  if (job.ended !== null) {
    return (
      <Text size="sm" {...(job.ended.end === 'cancelled' ? {} : { c: 'red' })} role="alert">
        {t(`tries.ended.${job.ended.end}`, { message: job.ended.message })}
      </Text>
    );
  }
  const words = t(job.stage === 'going_back' ? 'tries.goingBack' : 'tries.continuing');
  return (
    <Group gap="sm" data-testid="tries-going">
      <Text size="sm" role="status">
        {words}
      </Text>
      <Progress flex={1} miw={80} value={Math.round(job.fraction * 100)} aria-label={words} />
      <Button size="compact-sm" variant="default" onClick={stopTries} data-testid="tries-stop">
        {t('tries.stop')}
      </Button>
    </Group>
  );
}
