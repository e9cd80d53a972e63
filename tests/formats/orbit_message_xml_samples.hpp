#pragma once

// The messages of orbit_message_samples.hpp in XML notation, by CCSDS 505.0-B-3, with the same
// numbers.

namespace hamjet::io {

inline constexpr const char* standard_oem_xml = R"(<?xml version="1.0" encoding="UTF-8"?>
<oem xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" id="CCSDS_OEM_VERS" version="3.0">
<header>
<COMMENT>of the standard</COMMENT>
<CREATION_DATE>1996-11-04T17:22:31</CREATION_DATE>
<ORIGINATOR>NASA/JPL</ORIGINATOR>
</header>
<body>
<segment>
<metadata>
<OBJECT_NAME>MARS GLOBAL SURVEYOR</OBJECT_NAME>
<OBJECT_ID>1996-062A</OBJECT_ID>
<CENTER_NAME>MARS BARYCENTER</CENTER_NAME>
<REF_FRAME>EME2000</REF_FRAME>
<TIME_SYSTEM>UTC</TIME_SYSTEM>
<START_TIME>2019-12-18T12:00:00.331</START_TIME>
<USEABLE_START_TIME>2019-12-18T12:10:00.331</USEABLE_START_TIME>
<USEABLE_STOP_TIME>2019-12-28T21:23:00.331</USEABLE_STOP_TIME>
<STOP_TIME>2019-12-28T21:28:00.331</STOP_TIME>
<INTERPOLATION>HERMITE</INTERPOLATION>
<INTERPOLATION_DEGREE>7</INTERPOLATION_DEGREE>
</metadata>
<data>
<stateVector>
<EPOCH>2019-12-18T12:00:00.331</EPOCH>
<X units="km">2789.619</X> <Y units="km">-280.045</Y> <Z units="km">-1746.755</Z>
<X_DOT units="km/s">4.73372</X_DOT> <Y_DOT units="km/s">-2.49586</Y_DOT> <Z_DOT units="km/s">-1.04195</Z_DOT>
</stateVector>
<stateVector>
<EPOCH>2019-12-18T12:01:00.331</EPOCH>
<X>2783.419</X> <Y>-308.143</Y> <Z>-1877.071</Z>
<X_DOT>5.18604</X_DOT> <Y_DOT>-2.42124</Y_DOT> <Z_DOT>-1.99608</Z_DOT>
</stateVector>
<stateVector>
<EPOCH>2019-12-18T12:02:00.331</EPOCH>
<X>2776.033</X> <Y>-336.859</Y> <Z>-2008.682</Z>
<X_DOT>5.63678</X_DOT> <Y_DOT>-2.33951</Y_DOT> <Z_DOT>-1.94687</Z_DOT>
</stateVector>
<stateVector>
<EPOCH>2019-12-28T21:28:00.331</EPOCH>
<X>-3881.024</X> <Y>563.959</Y> <Z>-682.773</Z>
<X_DOT>-3.28827</X_DOT> <Y_DOT>-3.66735</Y_DOT> <Z_DOT>1.63861</Z_DOT>
</stateVector>
</data>
</segment>
<segment>
<metadata>
<OBJECT_NAME>MARS GLOBAL SURVEYOR</OBJECT_NAME>
<OBJECT_ID>1996-062A</OBJECT_ID>
<CENTER_NAME>MARS BARYCENTER</CENTER_NAME>
<REF_FRAME>EME2000</REF_FRAME>
<TIME_SYSTEM>UTC</TIME_SYSTEM>
<START_TIME>2019-12-28T21:29:07.267</START_TIME>
<STOP_TIME>2019-12-30T01:28:02.267</STOP_TIME>
</metadata>
<data>
<COMMENT>This block begins after trajectory correction maneuver TCM-3.</COMMENT>
<stateVector>
<EPOCH>2019-12-28T21:29:07.267</EPOCH>
<X>-2432.166</X> <Y>-063.042</Y> <Z>1742.754</Z>
<X_DOT>7.33702</X_DOT> <Y_DOT>-3.495867</Y_DOT> <Z_DOT>-1.041945</Z_DOT>
</stateVector>
<stateVector>
<EPOCH>2019-12-28T21:59:02.267</EPOCH>
<X>-2445.234</X> <Y>-878.141</Y> <Z>1873.073</Z>
<X_DOT>1.86043</X_DOT> <Y_DOT>-3.421256</Y_DOT> <Z_DOT>-0.996366</Z_DOT>
</stateVector>
<stateVector>
<EPOCH>2019-12-28T22:00:02.267</EPOCH>
<X>-2458.079</X> <Y>-683.858</Y> <Z>2007.684</Z>
<X_DOT>6.36786</X_DOT> <Y_DOT>-3.339563</Y_DOT> <Z_DOT>-0.946654</Z_DOT>
</stateVector>
<stateVector>
<EPOCH>2019-12-30T01:28:02.267</EPOCH>
<X units="km">2164.375</X> <Y units="km">1115.811</Y> <Z units="km">-688.131</Z>
<X_DOT units="km/s">-3.53328</X_DOT> <Y_DOT units="km/s">-2.88452</Y_DOT> <Z_DOT units="km/s">0.88535</Z_DOT>
<X_DDOT units="km/s**2">0.1</X_DDOT> <Y_DDOT units="km/s**2">0.2</Y_DDOT> <Z_DDOT units="km/s**2">0.3</Z_DDOT>
</stateVector>
<covarianceMatrix>
<EPOCH>2019-12-28T21:29:07.267</EPOCH>
<COV_REF_FRAME>EME2000</COV_REF_FRAME>
<CX_X units="km**2">3.3313494e-04</CX_X>
<CY_X units="km**2">4.6189273e-04</CY_X> <CY_Y units="km**2">6.7824216e-04</CY_Y>
<CZ_X units="km**2">-3.0700078e-04</CZ_X> <CZ_Y units="km**2">-4.2212341e-04</CZ_Y>
<CZ_Z units="km**2">3.2319319e-04</CZ_Z>
<CX_DOT_X units="km**2/s">-3.3493650e-07</CX_DOT_X> <CX_DOT_Y units="km**2/s">-4.6860842e-07</CX_DOT_Y>
<CX_DOT_Z units="km**2/s">2.4849495e-07</CX_DOT_Z> <CX_DOT_X_DOT units="km**2/s**2">4.2960228e-10</CX_DOT_X_DOT>
<CY_DOT_X units="km**2/s">-2.2118325e-07</CY_DOT_X> <CY_DOT_Y units="km**2/s">-2.8641868e-07</CY_DOT_Y>
<CY_DOT_Z units="km**2/s">1.7980986e-07</CY_DOT_Z> <CY_DOT_X_DOT units="km**2/s**2">2.6088992e-10</CY_DOT_X_DOT>
<CY_DOT_Y_DOT units="km**2/s**2">1.7675147e-10</CY_DOT_Y_DOT>
<CZ_DOT_X units="km**2/s">-3.0413460e-07</CZ_DOT_X> <CZ_DOT_Y units="km**2/s">-4.9894969e-07</CZ_DOT_Y>
<CZ_DOT_Z units="km**2/s">3.5403109e-07</CZ_DOT_Z> <CZ_DOT_X_DOT units="km**2/s**2">1.8692631e-10</CZ_DOT_X_DOT>
<CZ_DOT_Y_DOT units="km**2/s**2">1.0088625e-10</CZ_DOT_Y_DOT> <CZ_DOT_Z_DOT units="km**2/s**2">6.2244443e-10</CZ_DOT_Z_DOT>
</covarianceMatrix>
</data>
</segment>
</body>
</oem>
)";

inline constexpr const char* standard_opm_xml = R"(<?xml version="1.0" encoding="UTF-8"?>
<opm id="CCSDS_OPM_VERS" version="3.0">
<header>
<CREATION_DATE>2021-06-03T05:33:00.000</CREATION_DATE>
<ORIGINATOR>GSOC</ORIGINATOR>
</header>
<body>
<segment>
<metadata>
<OBJECT_NAME>EUTELSAT W4</OBJECT_NAME>
<OBJECT_ID>2021-028A</OBJECT_ID>
<CENTER_NAME>EARTH</CENTER_NAME>
<REF_FRAME>TOD</REF_FRAME>
<TIME_SYSTEM>UTC</TIME_SYSTEM>
</metadata>
<data>
<stateVector>
<EPOCH>2021-06-03T00:00:00.000</EPOCH>
<X units="km">6655.9942</X>
<Y units="km">-40218.5751</Y>
<Z units="km">-82.9177</Z>
<X_DOT units="km/s">3.11548208</X_DOT>
<Y_DOT units="km/s">0.47042605</Y_DOT>
<Z_DOT units="km/s">-0.00101495</Z_DOT>
</stateVector>
<keplerianElements>
<SEMI_MAJOR_AXIS units="km">41399.5123</SEMI_MAJOR_AXIS>
<ECCENTRICITY>0.020842611</ECCENTRICITY>
<INCLINATION units="deg">0.117746</INCLINATION>
<RA_OF_ASC_NODE units="deg">17.604721</RA_OF_ASC_NODE>
<ARG_OF_PERICENTER units="deg">218.242943</ARG_OF_PERICENTER>
<TRUE_ANOMALY units="deg">41.922339</TRUE_ANOMALY>
<GM units="km**3/s**2">398600.4415</GM>
</keplerianElements>
<spacecraftParameters>
<MASS units="kg">1913.000</MASS>
<SOLAR_RAD_AREA units="m**2">10.000</SOLAR_RAD_AREA>
<SOLAR_RAD_COEFF>1.300</SOLAR_RAD_COEFF>
<DRAG_AREA units="m**2">10.000</DRAG_AREA>
<DRAG_COEFF>2.300</DRAG_COEFF>
</spacecraftParameters>
</data>
</segment>
</body>
</opm>
)";

}  // namespace hamjet::io
