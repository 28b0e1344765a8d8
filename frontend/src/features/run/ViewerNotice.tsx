import { Button, CloseButton } from '@mantine/core';
import { IconSteeringWheel } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { useSessionStore } from '@/store/session/store';
import classes from './run.module.css';

/** Shown while another page controls the session; offers to take control. */
export function ViewerNotice() {
  const { t } = useTranslation('run');
  const client = useSessionStore(({ connection, introspection }) =>
    connection === 'open' && introspection?.role === 'viewer' ? introspection.client_id : null,
  );
  const wasTakenOver = useSessionStore((state) => state.wasTakenOver);
  // The user dismissed the notice; Run's tooltip still shows the reason.
  const [read, setRead] = useState('');
  const key = `${client} ${wasTakenOver}`;
  if (client === null || read === key) return null;
  return (
    <div className={classes['offer']} role="status" data-testid="looking-on" data-taken={wasTakenOver}>
      <span>
        {t(wasTakenOver ? 'takenOver' : 'runBlocker.viewer')}{' '}
        <span className={classes['hint']}>{t('takeOverHelp')}</span>
      </span>
      <Button
        size="compact-sm"
        leftSection={<IconSteeringWheel size={15} />}
        onClick={() => perform('run.takeOver')}
      >
        {t(wasTakenOver ? 'takeBack' : 'takeOver')}
      </Button>
      <CloseButton size="sm" aria-label={t('dismiss')} onClick={() => setRead(key)} />
    </div>
  );
}
