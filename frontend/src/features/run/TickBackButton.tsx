import { useTranslation } from 'react-i18next';
import { whyNoTickBack } from '@/store/debug/tickBack';
import { useIsBack } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';
import { CommandButton } from '@/ui/CommandButton';

/** A button that takes world and program one tick back, or says why that is not possible. */
export function TickBackButton() {
  const { t } = useTranslation('debug');
  useIsBack(); // `whyNoTickBack` asks for it
  const why = useSessionStore(whyNoTickBack);
  return <CommandButton command="debug.tickBack" testId="tick-back" reason={why && t(`tickBack.${why}`)} />;
}
