import { Alert, Badge, Button, Group, Modal, Stack, Text } from '@mantine/core';
import { useMutation, useQuery, useQueryClient } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { fetchAgain } from '@/api/queries';
import type { OwnSession } from '@/api/types';
import { closeOwnRobots, useOwnRobots } from '@/store/dialogs/ownRobots';
import { useProjectStore } from '@/store/project';
import { end } from '@/store/run/commands';
import { cancelRun } from '@/store/run/run';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';

const KEY = ['sessions'];
const AGAIN_MS = 2000;

/** A dialogue with the robots of the user in all projects, each of which can be ended. */
export function OwnRobots() {
  const { t } = useTranslation('run');
  const isOpen = useOwnRobots((state) => state.isOpen);
  return (
    <Modal
      opened={isOpen}
      onClose={closeOwnRobots}
      title={t('ownRobots.title')}
      closeButtonProps={{ 'aria-label': t('ownRobots.close') }}
      centered
    >
      {isOpen ? <Robots /> : null}
    </Modal>
  );
}

function Robots() {
  const { t } = useTranslation('run');
  const queries = useQueryClient();
  const { data, error } = useQuery({ queryKey: KEY, queryFn: api.ownSessions, refetchInterval: AGAIN_MS });
  const ending = useMutation({
    mutationFn: endRobot,
    onSettled: () => fetchAgain(queries, KEY),
  });
  const problem = ending.error ?? error;
  return (
    <Stack gap="md" data-testid="own-robots">
      <Text size="sm" c="dimmed">
        {t('ownRobots.note')}
      </Text>
      {problem ? (
        <Alert color="red" role="alert" title={ending.error ? undefined : t('ownRobots.failed')}>
          {problem.message}
        </Alert>
      ) : null}
      {data?.length === 0 ? <Text>{t('ownRobots.none')}</Text> : null}
      <Stack gap={6} component="ul" m={0} p={0} aria-label={t('ownRobots.title')}>
        {data?.map((row) => (
          <Robot
            key={row.id}
            row={row}
            isEnding={ending.isPending && ending.variables.id === row.id}
            onEnd={() => ending.mutate(row)}
          />
        ))}
      </Stack>
    </Stack>
  );
}

/** Ends a robot; the page ends its own as its buttons do, so that nothing seems to be lost. */
async function endRobot({ id, project_id }: OwnSession): Promise<void> {
  if (useSessionStore.getState().sessionId === id) return end();
  const isStarting = useRunStore.getState().stage === 'starting';
  if (isStarting && project_id === useProjectStore.getState().projectId) return cancelRun();
  await api.endSession(id);
}

interface RobotProps {
  readonly row: OwnSession;
  readonly isEnding: boolean;
  readonly onEnd: () => void;
}

function Robot({ row, isEnding, onEnd }: RobotProps) {
  const { t } = useTranslation('run');
  const isHere = useProjectStore((state) => state.projectId === row.project_id);
  const name = row.project_name || row.target;
  return (
    <Group component="li" gap={8} wrap="nowrap" style={{ listStyle: 'none' }}>
      <Text size="sm" truncate="end" flex={1} title={name}>
        {name}
        {isHere ? <span> ({t('ownRobots.here')})</span> : null}
      </Text>
      <Badge variant="light" tt="none" style={{ flexShrink: 0 }}>
        {t(`ownRobots.state.${row.state}`)}
      </Badge>
      <Button
        size="compact-sm"
        variant="light"
        color="red"
        style={{ flexShrink: 0 }}
        loading={isEnding}
        aria-label={t('ownRobots.endOf', { name })}
        onClick={onEnd}
      >
        {t('ownRobots.end')}
      </Button>
    </Group>
  );
}
