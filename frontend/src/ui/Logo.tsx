interface LogoProps {
  readonly size?: number;
}

/** The logo, as in favicon.svg: a root with two leaves, a condition (round) and an action (square). */
export function Logo({ size = 24 }: LogoProps) {
  return (
    <svg width={size} height={size} viewBox="0 0 32 32" aria-hidden="true" focusable="false">
      <rect width="32" height="32" rx="8" fill="#4c5fe0" />
      <path
        d="M16 12v4M9 21v-1.5a3.5 3.5 0 0 1 3.5-3.5h7a3.5 3.5 0 0 1 3.5 3.5V21"
        fill="none"
        stroke="#fff"
        strokeWidth="2"
        strokeLinecap="round"
      />
      <rect x="11.5" y="5" width="9" height="7" rx="2" fill="#fff" />
      <circle cx="9" cy="24" r="3.2" fill="#5eead4" />
      <rect x="20" y="21" width="6" height="6" rx="1.6" fill="#fbbf24" />
    </svg>
  );
}
