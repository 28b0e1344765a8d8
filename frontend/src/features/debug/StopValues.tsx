import { useTranslation } from 'react-i18next';
import { showValue } from '@/features/blackboard/value';
import { nodeOf } from '@/store/debug/debugger';
import { portsOf, type StopPort } from '@/store/debug/stopPorts';
import { useIsBack } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';
import { useHeldWords } from './words';
import classes from './debug.module.css';

interface StopValuesProps {
  readonly tree: string;
  readonly node: string;
}

/** What a block has at the moment at which the tree is held: its status and the values of its ports. */
export function StopValues({ tree, node }: StopValuesProps) {
  const { t } = useTranslation('debug');
  const session = useSessionStore();
  const isBack = useIsBack();
  const words = useHeldWords();
  const { held } = session;
  const running = held ? nodeOf(session, tree, node) : undefined;
  if (!held || !running || isBack) return null;
  const status = held.statuses.find(([uid]) => uid === running.uid)?.[1] ?? 'IDLE';
  const ports = portsOf(running, session);
  return (
    <div data-testid="stop-values">
      <p className={classes['note']} data-testid="stop-status">
        {held.uid === running.uid ? `${t('heldHere')} ${words(held)}` : t('statusNow', { status })}
      </p>
      {ports.length > 0 && (
        <table className={classes['ports']}>
          <thead>
            <tr>
              <th scope="col">{t('port')}</th>
              <th scope="col">{t('value')}</th>
            </tr>
          </thead>
          <tbody>
            {ports.map((port) => (
              <tr key={port.name}>
                <th scope="row">{port.name}</th>
                <td data-testid={`stop-${port.name}`}>
                  <Value port={port} />
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </div>
  );
}

function Value({ port }: { readonly port: StopPort }) {
  const { t } = useTranslation('debug');
  if (port.key === null) return <code>{port.text}</code>;
  return (
    <>
      <code>{port.isSet ? showValue(port.value) : t('unset')}</code>{' '}
      <span className={classes['note']}>{`{${port.key}}`}</span>
    </>
  );
}
