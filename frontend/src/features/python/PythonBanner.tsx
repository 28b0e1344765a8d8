import { Button, Group } from '@mantine/core';
import { IconHandStop } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { TickBackButton } from '@/features/run/TickBackButton';
import { openFile } from '@/store/project/navigation';
import { shownFrame, usePython } from '@/store/python/stop';
import { useSessionStore } from '@/store/session/store';
import { CommandButton } from '@/ui/CommandButton';
import { showPanel } from '@/workspace/tabs';
import classes from './python.module.css';

const COMMANDS = ['debug.continue', 'debug.over', 'debug.into', 'debug.out'];

/** The banner of a program that is held at a line of Python; nothing while none is. */
export function PythonBanner() {
  const { t } = useTranslation('debug');
  const stop = usePython((state) => state.stop);
  const frame = usePython(shownFrame);
  const isHeld = useSessionStore(({ executor, held }) => executor === 'held' && held === null);
  if (!stop && !isHeld) return null;
  return (
    <section className={classes['banner']} aria-label={t('python.held')} data-testid="python-banner">
      <IconHandStop size={18} aria-hidden="true" />
      <div className={classes['words']} role="status">
        {stop && frame ? (
          <>
            {t('python.heldIn', { name: frame.name })}{' '}
            <button
              type="button"
              className={classes['place']}
              onClick={() => openFile(frame.path, frame.line)}
              disabled={!frame.path}
              data-testid="python-place"
            >
              {frame.path}:{frame.line}
            </button>{' '}
            {stop.text || t(`python.reason.${stop.reason}`, { defaultValue: '' })}
          </>
        ) : (
          t('python.heldElsewhere')
        )}
      </div>
      {stop && (
        <Group gap={2} wrap="nowrap">
          <Button
            size="compact-sm"
            variant="subtle"
            data-testid="python-values"
            onClick={() => showPanel('breakpoints')}
          >
            {t('python.variables')}
          </Button>
          {COMMANDS.map((id) => (
            <CommandButton key={id} command={id} testId={id.replace('.', '-')} />
          ))}
          <TickBackButton />
        </Group>
      )}
    </section>
  );
}
