import { Group, NumberInput, Stack, Switch, Text } from '@mantine/core';
import { useMutation } from '@tanstack/react-query';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { reasonOf } from '@/api/reason';
import { send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';

const USUAL_PORT = 1667;
const LAST_PORT = 65534;

/** A switch that lets Groot2 look at the trees of this session, with the port for it. */
export function Groot2Switch() {
  const { t } = useTranslation('topics');
  const served = useSessionStore((state) => state.groot2);
  const isViewer = useSessionStore((state) => state.introspection?.role === 'viewer');
  const [chosen, setChosen] = useState<number | string>(served || USUAL_PORT);
  const { mutate, isPending, error, reset } = useMutation({
    mutationFn: (port: number) => send('serve_groot2', { port }),
  });
  const port = served || chosen;
  const isPort = typeof port === 'number' && Number.isInteger(port) && port > 0 && port <= LAST_PORT;
  return (
    <Stack gap="xs">
      <Group justify="space-between" align="start" wrap="nowrap">
        <Switch
          checked={served > 0}
          label={t('groot2.title')}
          description={served ? t('groot2.served', { port: served }) : t('groot2.help')}
          disabled={isViewer || isPending || !isPort}
          data-testid="groot2-switch"
          onChange={({ currentTarget }) => mutate(currentTarget.checked ? Number(port) : 0)}
        />
        <NumberInput
          w={110}
          flex="none"
          aria-label={t('groot2.port')}
          value={port}
          allowDecimal={false}
          allowNegative={false}
          hideControls
          disabled={served > 0 || isViewer}
          error={!isPort}
          data-testid="groot2-port"
          onChange={(value) => {
            setChosen(value);
            reset();
          }}
        />
      </Group>
      <Text size="sm" c="red" role="alert">
        {isPort ? error && reasonOf(error) : t('groot2.outOfRange')}
      </Text>
    </Stack>
  );
}
