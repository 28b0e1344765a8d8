import { useTranslation } from 'react-i18next';
import classes from '../explorer.module.css';
import { useInUse } from './inUse';
import { UsedItem } from './UsedItem';

/**
 * The section with the universe and the robot that the project uses, whether built in or part of the project.
 */
export function UsedSection() {
  const { t } = useTranslation('frame');
  const found = useInUse();
  if (found.length === 0) return null;
  return (
    <section aria-labelledby="explorer-used">
      <div className={classes['heading']}>
        <h2 id="explorer-used">{t('explorer.used.title')}</h2>
      </div>
      <ul className={classes['list']}>
        {found.map((used) => (
          <li key={used.kind}>
            <UsedItem used={used} />
          </li>
        ))}
      </ul>
    </section>
  );
}
