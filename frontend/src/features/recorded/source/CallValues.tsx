import { useTranslation } from 'react-i18next';
import type { SourceCall, SourceValue } from '@/generated/messages';
import classes from './source.module.css';

/** How a call ended, and what its local variables and the fields of its action were then. */
export function CallValues({ call }: { readonly call: SourceCall }) {
  const { t } = useTranslation('axis');
  return (
    <div className={classes['values']} data-testid="call-values">
      <p className={classes['end']} data-end={call.end}>
        {t(`source.end.${call.end}`, { result: call.result })}
      </p>
      <Values title={t('source.locals')} values={call.locals} />
      <Values title={t('source.fields')} values={call.fields} />
    </div>
  );
}

interface ValuesProps {
  readonly title: string;
  readonly values: readonly SourceValue[];
}

function Values({ title, values }: ValuesProps) {
  if (values.length === 0) return null;
  return (
    <table className={classes['table']}>
      <caption>{title}</caption>
      <tbody>
        {values.map(({ name, text }) => (
          <tr key={name}>
            <th scope="row">{name}</th>
            <td>
              <code>{text}</code>
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
